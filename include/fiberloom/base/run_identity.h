// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_run_identity_h
#define fiberloom_base_run_identity_h

#include <fiberloom/base/parameters.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace fiberloom
{
  /** Which run a file is of, and what that run was to do. */
  struct RunIdentity
  {
    std::string id;    // random; a run that goes on in its directory keeps it
    std::string asked; // all entries, as Parameters::print() writes them

    template <class Archive>
    void
    serialize(Archive &ar, const unsigned int)
    {
      ar &id &asked;
    }
  };

  /** The identity of a new run, the same on every rank. Collective. */
  RunIdentity
  new_run(const Parameters &parameters, const MPI_Comm comm);

  /**
   * Entries that decide on results and that differ between two texts of
   * Parameters::print(), such as "Contact/Friction coefficient = 0.9, which was
   * 0.2". Where and when a run ends, and what it writes, do not count, nor
   * which stages it has.
   */
  std::vector<std::string>
  changed_entries(const std::string &before, const std::string &now);
} // namespace fiberloom

#endif
