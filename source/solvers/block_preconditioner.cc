// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/block_preconditioner.h>

#include <Epetra_MultiVector.h>

namespace fiberloom
{
  BlockPreconditioner::BlockPreconditioner(
    const MPI_Comm                comm,
    const DirectFactor::Precision precision)
    : fibers(comm, precision, DirectFactor::Part::fibers_and_bodies)
    , hexes(comm, precision, DirectFactor::Part::matrix)
  {}



  void
  BlockPreconditioner::analyse(const BlockMatrix &matrix)
  {
    fibers.analyse(matrix);
    hexes.analyse(matrix);
  }



  void
  BlockPreconditioner::forget()
  {
    fibers.forget();
    hexes.forget();
  }



  int
  BlockPreconditioner::factorize(const BlockMatrix &matrix)
  {
    this->matrix        = &matrix;
    const int of_fibers = fibers.factorize(matrix);
    const int of_hexes  = hexes.factorize(matrix);
    return of_fibers < 0 || of_hexes < 0 ? -1 : of_fibers + of_hexes;
  }



  int
  BlockPreconditioner::ApplyInverse(const Epetra_MultiVector &x,
                                    Epetra_MultiVector       &y) const
  {
    const BlockLayout &layout = matrix->layout();
    Epetra_MultiVector product(x.Map(), 1);
    for (int v = 0; v < y.NumVectors(); ++v)
      {
        Epetra_MultiVector moved(Copy, x, v, 1);
        fibers.solve(layout, moved[0]);
        const auto set_hexes = [&](const auto &value) {
          for (unsigned int row = 0; row < layout.owned_blocks().size(); ++row)
            if (const unsigned int block = layout.owned_blocks()[row];
                layout.is_matrix_node(block))
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const unsigned int dof = layout.local_first_dof(row) + i;
                  moved[0][dof]          = value(dof);
                }
        };
        set_hexes([](const unsigned int) { return 0.; });
        matrix->Apply(moved, product);
        set_hexes(
          [&](const unsigned int dof) { return x[v][dof] - product[0][dof]; });
        hexes.solve(layout, moved[0]);
        std::copy(moved[0], moved[0] + moved.MyLength(), y[v]);
      }
    return 0;
  }
} // namespace fiberloom
