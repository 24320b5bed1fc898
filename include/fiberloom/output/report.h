// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_report_h
#define fiberloom_output_report_h

#include <fiberloom/output/curves.h>
#include <fiberloom/output/summary.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /** A picture in report.html. */
  struct ReportPicture
  {
    std::string file; // .png or .svg
    std::string caption;
  };

  /** What report.html shows of a run. */
  struct Report
  {
    std::string                scene;      // the file
    std::string                parameters; // all entries in force
    const Summary             &summary;
    const LoadingCurve        &curve;
    std::vector<ReportPicture> last;    // of the last stage that is done
    std::vector<ReportPicture> earlier; // of those before, folded
  };

  /**
   * One page of HTML that holds all it shows, pictures included, so that it can
   * be sent and printed: the model, loading curves with their estimated error
   * as a band, pictures, measures of the fabric, iterations and seconds of the
   * stages, parameters. Throws InputError if a picture cannot be read.
   */
  std::string
  report_html(const Report &report);

  /**
   * Slices in @p directory whose names end with @p label , such as
   * biaxial_0012, in alphabetical order.
   */
  std::vector<std::string>
  slices_of_increment(const std::string &directory, const std::string &label);
} // namespace fiberloom

#endif
