// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/output/files.h>
#include <fiberloom/output/report.h>
#include <fiberloom/output/svg.h>

#include <deal.II/base/utilities.h>

#include <boost/format.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace fiberloom
{
  namespace
  {
    using Cells = std::vector<std::string>;

    constexpr double mebibyte = 1024. * 1024.;

    const char *const style = R"(
body { font: 15px/1.45 "DejaVu Sans", Helvetica, sans-serif; color: #222;
       max-width: 1000px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; margin: 0; }
h2 { font-size: 1.15em; margin: 1.4em 0 .4em; border-bottom: 1px solid #ccc; }
table { border-collapse: collapse; font-size: .87em; }
th, td { text-align: right; padding: .15em .5em; border-bottom: 1px solid #eee; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
.pictures { display: flex; flex-wrap: wrap; gap: 1em; }
figure { margin: 0; flex: 1 1 420px; }
figure img { max-width: 100%; max-height: 420px; }
figcaption { font-size: .85em; color: #555; }
.failed { color: #b00; font-weight: bold; }
pre { font-size: .8em; white-space: pre-wrap; }
@page { size: A4; margin: 12mm; }
@media print {
  body { font-size: 11px; margin: 0; max-width: none; }
  figure, table { break-inside: avoid; }
  figure { flex-basis: 85mm; }
  figure img { max-height: 62mm; }
  details:not([open]) { display: none; }
}
)";

    std::string
    number(const double value)
    {
      return std::isfinite(value) ? short_number(value) : "–";
    }

    std::string
    percent(const double part)
    {
      if (!std::isfinite(part))
        return "–";
      std::ostringstream text;
      text << std::setprecision(2) << 100 * part << " %";
      return text.str();
    }

    std::string
    seconds(const double value)
    {
      return (boost::format("%.1f") % value).str();
    }

    std::string
    table_row(const Cells &cells, const std::string &tag = "td")
    {
      std::string row;
      for (const std::string &cell : cells)
        row += "<" + tag + ">" + escaped(cell) + "</" + tag + ">";
      return "<tr>" + row + "</tr>\n";
    }

    std::string
    table(const Cells &header, const std::vector<Cells> &rows)
    {
      std::string text = "<table>\n";
      if (!header.empty())
        text += table_row(header, "th");
      for (const Cells &row : rows)
        text += table_row(row);
      return text + "</table>\n";
    }

    std::string
    figure(const std::string &content,
           const std::string &type,
           const std::string &caption)
    {
      return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/" +
             type + ";base64," +
             dealii::Utilities::encode_base64(
               std::vector<unsigned char>(content.begin(), content.end())) +
             "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
    }

    std::string
    figures(const std::vector<ReportPicture> &pictures)
    {
      std::string text = "<div class=\"pictures\">\n";
      for (const ReportPicture &picture : pictures)
        text +=
          figure(read_file(picture.file),
                 std::filesystem::path(picture.file).extension() == ".svg" ?
                   "svg+xml" :
                   "png",
                 picture.caption);
      return text + "</div>\n";
    }

    std::string
    head(const Report &report)
    {
      const Summary   &summary = report.summary;
      const ModelSize &model   = summary.model;
      std::string      text    = "<h1>" + escaped(report.scene) +
                         "</h1>\n<p>fiberloom " + summary.version + " (" +
                         summary.revision + "), run " + summary.run + ". ";
      if (summary.preview)
        text += "<strong>A preview: woven roughly by coarse fibers that are "
                "not in balance; nothing is claimed of its accuracy."
                "</strong> ";
      text += summary.converged ?
                "All stages reached their end.</p>\n" :
                "<span class=\"failed\">The run did not reach its "
                "end.</span></p>\n";
      std::vector<Cells> rows = {{"fibers", std::to_string(model.fibers)},
                                 {"degrees of freedom",
                                  std::to_string(model.fiber_dofs +
                                                 model.matrix_dofs)}};
      if (model.matrix_dofs > 0)
        rows.push_back(
          {"of which of the matrix", std::to_string(model.matrix_dofs)});
      rows.push_back(
        {"contact elements", std::to_string(model.contact_elements)});
      rows.push_back({"ranks", std::to_string(summary.ranks)});
      rows.push_back(
        {"memory", number(summary.peak_memory_bytes / mebibyte) + " MiB"});
      return text + table({}, rows);
    }

    std::string
    curves(const Report &report)
    {
      std::string text;
      for (unsigned int s = 0; s < report.summary.stages.size(); ++s)
        {
          const StageStatistics &stage = report.summary.stages[s];
          const double           error = stage.estimated_error.total;
          const std::string picture    = curve_picture(report.curve, s, error);
          if (picture.empty())
            continue;
          text += figure(picture,
                         "svg+xml",
                         "stage " + stage.name +
                           (std::isfinite(error) ?
                              "; the band is the estimated error, " +
                                percent(error) + " of the largest value" :
                              ""));
        }
      return text.empty() ?
               "" :
               "<h2>Loading curves</h2>\n<div class=\"pictures\">\n" + text +
                 "</div>\n";
    }

    std::string
    fabric(const Summary &summary)
    {
      if (summary.fabric.empty())
        return "";
      std::vector<Cells> rows;
      for (const auto &[name, value] : summary.fabric)
        rows.push_back({readable(name), number(value)});
      return "<h2>Measures of the fabric</h2>\n" + table({}, rows);
    }

    std::string
    stages(const Summary &summary)
    {
      std::vector<Cells> rows;
      for (const StageStatistics &stage : summary.stages)
        {
          const Seconds &s = stage.seconds;
          rows.push_back({stage.name + (stage.converged ? "" : " (not done)"),
                          std::to_string(stage.increments),
                          std::to_string(stage.newton_iterations),
                          std::to_string(stage.contact_elements),
                          percent(stage.largest_penetration_over_radius),
                          percent(stage.estimated_error.total),
                          seconds(s.detection),
                          seconds(s.assembly),
                          seconds(s.linear_solver),
                          seconds(s.output),
                          seconds(s.estimate),
                          seconds(s.wall)});
        }
      return "<h2>Stages and seconds</h2>\n" + table({"stage",
                                                      "increments",
                                                      "iterations",
                                                      "contacts",
                                                      "penetration over radius",
                                                      "estimated error",
                                                      "detection",
                                                      "assembly",
                                                      "linear solver",
                                                      "output",
                                                      "estimate",
                                                      "all"},
                                                     rows);
    }
  } // namespace



  std::string
  report_html(const Report &report)
  {
    std::string text = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
                       "charset=\"utf-8\">\n<link rel=\"icon\" href=\"data:,\">"
                       "\n<title>" +
                       escaped(report.scene) + "</title>\n<style>" + style +
                       "</style></head><body>\n" + head(report) +
                       curves(report);
    if (!report.last.empty())
      text += "<h2>Pictures</h2>\n" + figures(report.last);
    if (!report.earlier.empty())
      text += "<details><summary>Earlier stages</summary>\n" +
              figures(report.earlier) + "</details>\n";
    return text + fabric(report.summary) + stages(report.summary) +
           "<h2>Parameters</h2>\n<details><summary>All entries in "
           "force</summary>\n<pre>" +
           escaped(report.parameters) + "</pre></details>\n</body></html>\n";
  }



  std::vector<std::string>
  slices_of_increment(const std::string &directory, const std::string &label)
  {
    const std::string        end = "_" + label + ".svg";
    std::vector<std::string> files;
    std::error_code          none;
    for (const auto &entry :
         std::filesystem::directory_iterator(directory, none))
      {
        const std::string file = entry.path().string();
        if (file.size() > end.size() &&
            file.compare(file.size() - end.size(), end.size(), end) == 0)
          files.push_back(file);
      }
    std::sort(files.begin(), files.end());
    return files;
  }
} // namespace fiberloom
