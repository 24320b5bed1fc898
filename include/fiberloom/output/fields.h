// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_fields_h
#define fiberloom_output_fields_h

#include <mpi.h>

#include <string>
#include <utility>
#include <vector>

class vtkUnstructuredGrid;

namespace fiberloom
{
  /**
   * One kind of field over time, for ParaView: NAME.pvd in the output
   * directory lists fields/NAME_LABEL.pvtu, which lists one compressed binary
   * .vtu per rank.
   */
  class FieldSeries
  {
  public:
    using Entries = std::vector<std::pair<double, std::string>>; // time, file

    FieldSeries(const std::string &output_directory,
                const std::string &name,
                const MPI_Comm     comm);

    /** Goes on after those of @p former that are not later than @p time . */
    void
    continue_from(const Entries &former, const double time);

    const Entries &
    entries() const
    {
      return all_entries;
    }

    const std::string &
    series() const
    {
      return name;
    }

    bool
    has(const double time) const;

    /**
     * Writes this rank's @p piece and lists it under @p time . Collective.
     * Throws StageFailure.
     */
    void
    write(vtkUnstructuredGrid *piece,
          const double         time,
          const std::string   &label);

  private:
    std::string
    collection() const;

    std::string directory;
    std::string name;
    MPI_Comm    comm;
    Entries     all_entries;
  };
} // namespace fiberloom

#endif
