// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/input_file.h>
#include <fiberloom/base/parameter_catalogue.h>

#include <fiberloom/fabric/fiber_file.h>
#include <fiberloom/fabric/fiber_table.h>
#include <fiberloom/fabric/vtk_fibers.h>

#include <cmath>
#include <filesystem>

namespace fiberloom
{
  namespace
  {
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



  FiberFile
  read_fiber_file(const std::string &file)
  {
    open_input_file(file, FiberFile::most_bytes);
    const std::string extension = std::filesystem::path(file).extension();
    if (extension != ".csv" && extension != ".vtp" && extension != ".vtu")
      throw InputError("is of no known kind; allowed: .csv, .vtp, .vtu");

    FiberFile found =
      extension == ".csv" ? read_fiber_table(file) : read_vtk_fibers(file);
    if (found.fibers.empty())
      throw InputError("has no fibers; allowed: one or more");
    check_values(found.fibers);
    return found;
  }
} // namespace fiberloom
