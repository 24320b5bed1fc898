// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

// A fixed computation with nothing of fiberloom in it, whose seconds measure
// the machine: Poisson's equation on 24 x 24 x 24 trilinear hexahedra,
// assembled, solved by conjugate gradients and factorised. Ends with status 1
// if both solutions differ.

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/numerics/vector_tools.h>

using namespace dealii;

int
main()
{
  Triangulation<3> mesh;
  GridGenerator::subdivided_hyper_cube(mesh, 24);
  const FE_Q<3> element(1);
  DoFHandler<3> dofs(mesh);
  dofs.distribute_dofs(element);
  AffineConstraints<double> held;
  VectorTools::interpolate_boundary_values(dofs,
                                           0,
                                           Functions::ZeroFunction<3>(),
                                           held);
  held.close();
  DynamicSparsityPattern couplings(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, couplings, held, false);
  SparsityPattern pattern;
  pattern.copy_from(couplings);

  SparseMatrix<double> matrix(pattern);
  Vector<double>       load(dofs.n_dofs()), iterated(dofs.n_dofs()),
    direct(dofs.n_dofs());
  const QGauss<3>                      quadrature(3);
  FEValues<3>                          values(element,
                     quadrature,
                     update_values | update_gradients | update_JxW_values);
  FullMatrix<double>                   stiffness(8, 8);
  Vector<double>                       force(8);
  std::vector<types::global_dof_index> numbers(8);
  for (int pass = 0; pass < 4; ++pass)
    {
      matrix = 0;
      load   = 0;
      for (const auto &cell : dofs.active_cell_iterators())
        {
          values.reinit(cell);
          stiffness = 0;
          force     = 0;
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int i = 0; i < 8; ++i)
              {
                for (unsigned int j = 0; j < 8; ++j)
                  stiffness(i, j) += values.shape_grad(i, q) *
                                     values.shape_grad(j, q) * values.JxW(q);
                force(i) += values.shape_value(i, q) * values.JxW(q);
              }
          cell->get_dof_indices(numbers);
          held.distribute_local_to_global(
            stiffness, force, numbers, matrix, load);
        }
    }

  SolverControl            control(1000, 1e-12 * load.l2_norm());
  SolverCG<Vector<double>> cg(control);
  PreconditionSSOR<>       preconditioner;
  preconditioner.initialize(matrix, 1.2);
  for (int pass = 0; pass < 4; ++pass)
    {
      iterated = 0;
      cg.solve(matrix, iterated, load, preconditioner);
    }

  SparseDirectUMFPACK factor;
  factor.initialize(matrix);
  factor.vmult(direct, load);
  direct -= iterated;
  return direct.l2_norm() < 1e-8 * iterated.l2_norm() ? 0 : 1;
}
