// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/memory.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>
#include <boost/format.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <vector>

extern "C" void
dgemm_(const char *,
       const char *,
       const int *,
       const int *,
       const int *,
       const double *,
       const double *,
       const int *,
       const double *,
       const int *,
       const double *,
       double *,
       const int *);

namespace fiberloom
{
  namespace
  {
    constexpr double unlimited = std::numeric_limits<double>::infinity();

    // Address space that libraries take besides what is counted as used: the
    // buffers of BLAS, and what drawing maps.
    constexpr double space_of_libraries = .3 * gibibyte;

    /** The number behind @p name in a file of lines "name number"; negative if
     * there is none. */
    double
    number_behind(const std::string &name, const std::string &file)
    {
      std::ifstream input(file);
      for (std::string word; input >> word;)
        if (double number; word == name && input >> number)
          return number;
      return -1;
    }

    /** The only number in a file; infinite where there is none, as in "max". */
    double
    number_in(const std::string &file)
    {
      double        number;
      std::ifstream input(file);
      return input >> number ? number : unlimited;
    }

    struct GroupFiles
    {
      std::string limit, usage, cache;
    };

    double
    left_in(const std::string &directory, const GroupFiles &files)
    {
      const double limit = number_in(directory + files.limit);
      const double usage = number_in(directory + files.usage);
      if (limit == unlimited || usage == unlimited)
        return unlimited;
      // Pages of files that nobody needs are given back.
      const double cache =
        number_behind(files.cache, directory + "/memory.stat");
      return std::max(0., limit - usage + std::max(0., cache));
    }

    /** In kB in the kernel's tables. */
    double
    status(const std::string &name)
    {
      return 1024 * std::max(0., number_behind(name, "/proc/self/status"));
    }

    std::string
    text(const double bytes)
    {
      return (boost::format("%.2f GiB") % (bytes / gibibyte)).str();
    }

    double
    limit_of(const int resource)
    {
      rlimit limits;
      return getrlimit(resource, &limits) == 0 &&
                 limits.rlim_cur != RLIM_INFINITY ?
               double(limits.rlim_cur) :
               unlimited;
    }
  } // namespace

  double
  memory_left_in_group(const std::string &groups, const std::string &root)
  {
    const GroupFiles first{"/memory.limit_in_bytes",
                           "/memory.usage_in_bytes",
                           "total_inactive_file"};
    const GroupFiles second{"/memory.max", "/memory.current", "inactive_file"};
    double           left = unlimited;
    std::ifstream    input(groups);
    for (std::string line; std::getline(input, line);)
      {
        // "4:memory:/group" or, in version 2, "0::/group".
        std::istringstream words(line);
        std::string        number, controllers, group;
        std::getline(words, number, ':');
        std::getline(words, controllers, ':');
        std::getline(words, group);
        const bool is_second = controllers.empty();
        if (!is_second && controllers != "memory")
          continue;
        const std::string top = root + (is_second ? "" : "/memory");
        for (group = group == "/" ? "" : group;;
             group.resize(group.find_last_of('/')))
          {
            left =
              std::min(left, left_in(top + group, is_second ? second : first));
            if (group.empty() || group[0] != '/')
              break;
          }
      }
    return left;
  }

  double
  memory_left_on_host()
  {
    const std::string table     = "/proc/meminfo";
    const double      available = number_behind("MemAvailable:", table);
    const double      swap = std::max(0., number_behind("SwapFree:", table));
    return std::min(available < 0 ? unlimited : 1024 * (available + swap),
                    memory_left_in_group());
  }

  double
  memory_left_to_process()
  {
    return std::max(0.,
                    std::min(limit_of(RLIMIT_AS) - status("VmSize:"),
                             limit_of(RLIMIT_DATA) - status("VmData:")));
  }

  bool
  fits_into_memory(const double   expected,
                   const MPI_Comm comm,
                   double        &available)
  {
    using namespace dealii::Utilities::MPI;

    MPI_Comm host;
    MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host);
    const double ranks        = n_mpi_processes(comm);
    const double used         = status("VmRSS:");
    const double missing      = std::max(0., expected / ranks - used);
    const double missing_here = sum(missing, host), used_here = sum(used, host);
    const double ranks_here = n_mpi_processes(host);
    MPI_Comm_free(&host);

    const double left_here = memory_left_on_host();
    const double left      = memory_left_to_process();
    const bool   fits =
      missing_here <= left_here && missing + space_of_libraries <= left;
    // As if all were like this one.
    available =
      min(ranks * std::min((used_here + left_here) / ranks_here,
                           std::max(0., used + left - space_of_libraries)),
          comm);
    return min(int(fits), comm) == 1;
  }

  void
  reserve_blas_buffers()
  {
    // Large enough not to be done without them.
    constexpr int             n = 128;
    const std::vector<double> a(n * n);
    std::vector<double>       c(n * n);
    const double              one = 1;
    dgemm_("N",
           "N",
           &n,
           &n,
           &n,
           &one,
           a.data(),
           &n,
           a.data(),
           &n,
           &one,
           c.data(),
           &n);
  }

  std::string
  out_of_memory()
  {
    const double limit = limit_of(RLIMIT_AS);
    return "out of memory: " +
           (limit == unlimited ?
              text(status("VmHWM:")) + " were in use, and " +
                text(memory_left_on_host()) + " are left" :
              text(status("VmPeak:")) + " were in use, and " + text(limit) +
                " is the limit of this process") +
           "; --check tells what a scene needs";
  }
} // namespace fiberloom
