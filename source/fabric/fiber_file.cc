// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/fiber_file.h>
#include <fiberloom/fabric/vtk_fibers.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace fiberloom
{
  namespace
  {
    constexpr std::array<const char *, 4> needed_columns{
      {"fiber", "x", "y", "z"}};

    std::vector<std::string>
    cells_of(const std::string &line)
    {
      std::vector<std::string> cells(1);
      for (const char c : line)
        if (c == ',')
          cells.emplace_back();
        else
          cells.back() += c;
      for (std::string &cell : cells)
        cell = dealii::Utilities::trim(cell);
      return cells;
    }

    /** A table with commas; '#' begins a comment. */
    class TableReader
    {
    public:
      explicit TableReader(const std::string &file)
        : in(file)
      {
        if (!next_row())
          throw InputError("is empty; allowed: a header and rows");
        header = row;
        for (std::string &name : header) // a unit may follow, as in x[mm]
          name = dealii::Utilities::trim(name.substr(0, name.find('[')));
        check_header();
      }

      bool
      next_row()
      {
        for (std::string line; std::getline(in, line);)
          {
            ++number;
            line.erase(std::min(line.find('#'), line.size()));
            line = dealii::Utilities::trim(line);
            if (line.empty())
              continue;
            row = cells_of(line);
            if (!header.empty() && row.size() != header.size())
              fail(std::to_string(row.size()) + " values; allowed: " +
                   std::to_string(header.size()) + " as in the header");
            return true;
          }
        return false;
      }

      bool
      has(const std::string &column) const
      {
        return std::count(header.begin(), header.end(), column) > 0;
      }

      double
      value(const std::string &column) const
      {
        const std::string &text =
          row[std::find(header.begin(), header.end(), column) - header.begin()];
        double      value = 0;
        const auto *end   = text.data() + text.size();
        const auto  read  = std::from_chars(text.data(), end, value);
        if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value))
          fail(column + " = " + text + "; allowed: a number");
        return value;
      }

      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("line " + std::to_string(number) + ": " + what);
      }

    private:
      std::ifstream            in;
      unsigned int             number = 0; // of the line
      std::vector<std::string> header, row;

      void
      check_header() const
      {
        std::string known;
        for (const std::string name : needed_columns)
          {
            known += name + ", ";
            if (!has(name))
              fail("there is no column " + name +
                   "; allowed: a header with fiber, x, y, z");
          }
        for (const std::string &name : header)
          {
            if (std::count(header.begin(), header.end(), name) > 1)
              fail("there are two columns " + name + "; allowed: one");
            if (std::count(needed_columns.begin(),
                           needed_columns.end(),
                           name) == 0 &&
                std::count(FiberPoints::value_names.begin(),
                           FiberPoints::value_names.end(),
                           name) == 0)
              fail("column \"" + name + "\" is unknown; allowed: " + known +
                   "radius, young_modulus, poisson_ratio");
          }
      }
    };

    std::vector<FiberPoints>
    read_table(const std::string &file)
    {
      TableReader              table(file);
      std::vector<FiberPoints> fibers;
      while (table.next_row())
        {
          const double number = table.value("fiber");
          const bool   is_new = number == fibers.size();
          if (is_new)
            fibers.emplace_back();
          else if (number + 1 != fibers.size())
            table.fail("fiber = " + exact_text(number) +
                       "; allowed: fibers one after the other, counted from "
                       "0, here " +
                       (fibers.empty() ?
                          "" :
                          std::to_string(fibers.size() - 1) + " or ") +
                       std::to_string(fibers.size()));

          FiberPoints &fiber = fibers.back();
          fiber.points.emplace_back(table.value("x"),
                                    table.value("y"),
                                    table.value("z"));
          for (std::size_t v = 0; v < fiber.values.size(); ++v)
            {
              const std::string name = FiberPoints::value_names[v];
              if (!table.has(name))
                continue;
              const double value = table.value(name);
              if (is_new)
                fiber.values[v] = value;
              else if (fiber.values[v] != value)
                table.fail(name + " changes along the fiber; allowed: one "
                                  "value a fiber");
            }
        }
      return fibers;
    }

    void
    check_values(const std::vector<FiberPoints> &fibers)
    {
      for (std::size_t f = 0; f < fibers.size(); ++f)
        {
          const std::string name = "fiber " + std::to_string(f) + ": ";
          for (std::size_t p = 0; p < fibers[f].points.size(); ++p)
            if (!fibers[f].points[p].allFinite())
              throw InputError(name + "point " + std::to_string(p) +
                               " is not finite; allowed: numbers");
          for (std::size_t v = 0; v < fibers[f].values.size(); ++v)
            {
              const bool   is_ratio = v == 2;
              const double value    = fibers[f].values[v].value_or(.25);
              if (!std::isfinite(value) ||
                  !(value > 0 || (is_ratio && value == 0)) ||
                  (is_ratio && value >= .5))
                throw InputError(
                  name + FiberPoints::value_names[v] + " = " +
                  exact_text(value) + "; allowed: a number " +
                  (is_ratio ? "of at least 0 and below 0.5" : "above 0"));
            }
        }
    }
  } // namespace



  std::vector<FiberPoints>
  read_fiber_file(const std::string &file)
  {
    if (!std::filesystem::exists(file))
      throw InputError("there is no such file");
    if (!std::filesystem::is_regular_file(file) || !std::ifstream(file))
      throw InputError("cannot be read");
    const std::string extension = std::filesystem::path(file).extension();
    if (extension != ".csv" && extension != ".vtp" && extension != ".vtu")
      throw InputError("is of no known kind; allowed: .csv, .vtp, .vtu");

    const std::vector<FiberPoints> fibers =
      extension == ".csv" ? read_table(file) : read_vtk_fibers(file);
    if (fibers.empty())
      throw InputError("has no fibers; allowed: one or more");
    check_values(fibers);
    return fibers;
  }
} // namespace fiberloom
