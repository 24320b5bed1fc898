// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/fiber_table.h>
#include <fiberloom/fabric/tow_family.h>
#include <fiberloom/fabric/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

namespace fiberloom
{
  namespace
  {
    constexpr std::array<const char *, 4> needed_columns{
      {"fiber", "x", "y", "z"}};

    // Of characters, before a line of any length is stored.
    constexpr std::size_t longest_line = 1000000;

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

    class TableReader
    {
    public:
      explicit TableReader(const std::string &file)
        : in(open_input_file(file, FiberFile::most_bytes))
        , buffer(longest_line + 1)
      {
        if (!next_row())
          throw InputError("is empty; allowed: a header and rows");
        for (const std::string &cell : row)
          headings.push_back(heading_of(cell));
        check_header();
        // One without the other makes no tows.
        if (!has("tow") || !has("family"))
          for (Heading &heading : headings)
            if (heading.name == "tow" || heading.name == "family")
              heading.is_read = false;
      }

      bool
      next_row()
      {
        for (std::string line; next_line(line);)
          {
            line.erase(std::min(line.find('#'), line.size()));
            line = dealii::Utilities::trim(line);
            if (line.empty())
              continue;
            row = cells_of(line);
            if (!headings.empty() && row.size() != headings.size())
              fail(std::to_string(row.size()) + " values; allowed: " +
                   std::to_string(headings.size()) + " as in the header");
            return true;
          }
        return false;
      }

      bool
      has(const std::string &column) const
      {
        return find(column) != headings.end();
      }

      bool
      has_tows() const
      {
        return has("tow") && find("tow")->is_read;
      }

      const std::string &
      text(const std::string &column) const
      {
        return row[find(column) - headings.begin()];
      }

      /** In mm or MPa. */
      double
      value(const std::string &column) const
      {
        const std::string &cell  = text(column);
        double             value = 0;
        const auto        *end   = cell.data() + cell.size();
        const auto         read  = std::from_chars(cell.data(), end, value);
        if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value))
          fail(column + " = " + cell + "; allowed: a number");
        return value * find(column)->factor;
      }

      std::vector<std::string>
      ignored() const
      {
        std::vector<std::string> names;
        for (const Heading &heading : headings)
          if (!heading.is_read)
            names.push_back(heading.name);
        return names;
      }

      [[noreturn]] void
      fail(const std::string &what) const
      {
        throw InputError("line " + std::to_string(number) + ": " + what);
      }

    private:
      std::ifstream            in;
      std::vector<char>        buffer;
      unsigned int             number = 0; // of the line
      std::vector<Heading>     headings;
      std::vector<std::string> row;

      bool
      next_line(std::string &line)
      {
        if (!in.getline(buffer.data(), buffer.size()) && in.gcount() == 0)
          return false;
        ++number;
        if (in.fail())
          fail("is longer than " + std::to_string(longest_line) +
               " characters; allowed: shorter lines");
        line.assign(buffer.data(), in.gcount() - (in.eof() ? 0 : 1));
        // what some programs put before the first character
        if (number == 1 && line.rfind("\xef\xbb\xbf", 0) == 0)
          line.erase(0, 3);
        return true;
      }

      Heading
      heading_of(const std::string &cell) const
      {
        try
          {
            return read_heading(cell);
          }
        catch (const InputError &error)
          {
            fail(error.what());
          }
      }

      std::vector<Heading>::const_iterator
      find(const std::string &column) const
      {
        return std::find_if(headings.begin(),
                            headings.end(),
                            [&column](const Heading &heading) {
                              return heading.name == column;
                            });
      }

      void
      check_header() const
      {
        for (const std::string name : needed_columns)
          if (!has(name))
            fail("there is no column " + name +
                 "; allowed: a header with fiber, x, y, z");
        for (const Heading &heading : headings)
          if (heading.is_read &&
              std::count_if(headings.begin(),
                            headings.end(),
                            [&heading](const Heading &other) {
                              return other.name == heading.name;
                            }) > 1)
            fail("there are two columns " + heading.name + "; allowed: one");
      }
    };

    /** The fiber of the row, a new one where its number is the next. */
    FiberPoints &
    fiber_of_row(const TableReader &table, std::vector<FiberPoints> &fibers)
    {
      const double number = table.value("fiber");
      if (number == fibers.size())
        fibers.emplace_back();
      else if (fibers.empty() || number + 1 != fibers.size())
        table.fail(
          "fiber = " + exact_text(number) +
          "; allowed: fibers one after the other, counted from 0, "
          "here " +
          (fibers.empty() ? "" : std::to_string(fibers.size() - 1) + " or ") +
          std::to_string(fibers.size()));
      return fibers.back();
    }

    /** Tows follow each other, those of the fiber before or the next. */
    void
    set_tow(const TableReader &table, std::vector<FiberPoints> &fibers)
    {
      const auto number = table.value("tow");
      const auto family = family_of_name(table.text("family"));
      if (!family)
        table.fail("family = " + table.text("family") +
                   "; allowed: warp, fill, none");
      FiberPoints &fiber = fibers.back();
      if (!fiber.points.empty())
        {
          if (number != *fiber.tow || family != fiber.family)
            table.fail("tow or family changes along the fiber; allowed: one "
                       "of each a fiber");
          return;
        }
      const std::size_t next =
        fibers.size() > 1 ? *fibers[fibers.size() - 2].tow + 1 : 0;
      if (number != next && (next == 0 || number + 1 != next))
        table.fail("tow = " + exact_text(number) +
                   "; allowed: fibers of one tow after those of another, "
                   "counted from 0, here " +
                   (next == 0 ? "" : std::to_string(next - 1) + " or ") +
                   std::to_string(next));
      fiber.tow    = number;
      fiber.family = family;
    }

    void
    add_row(const TableReader &table, FiberPoints &fiber)
    {
      const bool is_new = fiber.points.empty();
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
  } // namespace



  FiberFile
  read_fiber_table(const std::string &file)
  {
    TableReader table(file);
    FiberFile   found;
    found.ignored = table.ignored();
    found.read    = names_read();
    for (std::size_t n = 0; table.next_row(); ++n)
      {
        if (n == FiberFile::most_points)
          table.fail("there are more than " +
                     std::to_string(FiberFile::most_points) +
                     " points; allowed: fewer");
        FiberPoints &fiber = fiber_of_row(table, found.fibers);
        if (table.has_tows())
          set_tow(table, found.fibers);
        add_row(table, fiber);
      }
    return found;
  }
} // namespace fiberloom
