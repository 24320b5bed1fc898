// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/version.h>

#include <deal.II/base/config.h>

#include <boost/version.hpp>

#include <Eigen/Core>

// CGAL and VTK are not for this folder to see, so all of these are told by the
// build
#include <versions.h>

namespace fiberloom
{
  namespace
  {
    std::string
    dotted(const int major, const int minor, const int patch)
    {
      return std::to_string(major) + "." + std::to_string(minor) + "." +
             std::to_string(patch);
    }
  } // namespace

  std::string
  program_name()
  {
    return "fiberloom";
  }

  std::string
  program_version()
  {
    return FIBERLOOM_VERSION;
  }

  std::string
  program_revision()
  {
    return FIBERLOOM_REVISION;
  }

  std::vector<std::pair<std::string, std::string>>
  library_versions()
  {
    return {
      {"deal.II", DEAL_II_PACKAGE_VERSION},
      {"Trilinos",
       dotted(DEAL_II_TRILINOS_VERSION_MAJOR,
              DEAL_II_TRILINOS_VERSION_MINOR,
              DEAL_II_TRILINOS_VERSION_SUBMINOR)},
      {"Eigen",
       dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Boost",
       dotted(BOOST_VERSION / 100000,
              BOOST_VERSION / 100 % 1000,
              BOOST_VERSION % 100)},
      {"CGAL", FIBERLOOM_CGAL_VERSION},
      {"VTK", FIBERLOOM_VTK_VERSION}};
  }

  std::string
  version_text()
  {
    std::string text = program_name() + " " + program_version() +
                       ", revision " + program_revision() + "\nwith ";
    std::string separator;
    for (const auto &[library, version] : library_versions())
      {
        text += separator + library + " " + version;
        separator = ", ";
      }
    return text + "\n";
  }
} // namespace fiberloom
