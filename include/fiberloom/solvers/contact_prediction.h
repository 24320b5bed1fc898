// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_solvers_contact_prediction_h
#define fiberloom_solvers_contact_prediction_h

#include <fiberloom/solvers/increment.h>

#include <vector>

namespace fiberloom
{
  /**
   * Contacts that take part in one step with another stiffness than their own,
   * since their force will change otherwise than linearly along it. Section 4.4
   * of the theory has the secants.
   */
  class ContactPrediction
  {
  public:
    enum class Kind
    {
      closing, // contacts that close
      all      // and those whose force changes otherwise than linearly
    };

    /** References are kept. */
    ContactPrediction(const FiberMesh &mesh,
                      System          &system,
                      Increment       &increment,
                      const Problem   &problem,
                      const Kind       kind);

    /**
     * Adds to the system, which was assembled at @p state , the stiffness that
     * leads to the forces that contacts are to have at @p ahead . Whether there
     * are such contacts, which store at least @p least_energy there [N mm]. To
     * be called again with where that leads.
     */
    bool
    add_stiffness(const State &state,
                  const State &ahead,
                  const double least_energy = 0);

  private:
    const FiberMesh    &mesh;
    System             &system;
    Increment          &increment;
    const Problem      &problem;
    const Kind          kind;
    std::vector<double> stiffness; // predicted; below 0: their own [N/mm]
  };
} // namespace fiberloom

#endif
