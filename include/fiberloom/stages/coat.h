// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_stages_coat_h
#define fiberloom_stages_coat_h

#include <fiberloom/stages/coat_settings.h>
#include <fiberloom/stages/relax.h>

#include <string>

namespace fiberloom
{
  /**
   * Section 5 of the paper: layers of matrix and the junctions that hang them
   * on the fibers, both free of stress where the fibers are. Then the whole
   * comes to rest, which moves nothing if the fibers were at rest.
   */
  class Coat : public Relax
  {
  public:
    static StageType
    type();

    using Relax::Relax;

    Supports
    supports(const DofVector &start) const override;

    void
    begin(State &state) const override;

    CurveRow
    curve(const State                   &state,
          const std::vector<BodyVector> &reactions) const override;
  };

  /**
   * Gives @p state its matrix, before the equations of stage coat are set up.
   * Returns what the user should know. Throws InputError where no layer can be
   * made or no fiber is in reach.
   */
  std::string
  add_matrix(const Parameters &parameters, const FiberMesh &mesh, State &state);

  /** Throws InputError when @p parameters ask for too many junctions along the
   * fibers, before any work. */
  void
  check_junctions(const Parameters &parameters, const FiberMesh &mesh);

  /** Throws InputError when the matrix of a restart file is another one than
   * @p parameters describe. */
  void
  check_matrix(const Parameters &parameters, const MatrixState &matrix);
} // namespace fiberloom

#endif
