// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/solvers/section_preconditioner.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Cholesky>

#include <Epetra_MultiVector.h>

#include <algorithm>

namespace fiberloom
{
  namespace
  {
    using Node = Eigen::Matrix<double, 9, 1>;
  }



  SectionPreconditioner::SectionPreconditioner(
    const System                 &system,
    const DirectFactor::Precision precision)
    : sections(system)
    , factor(system.layout().communicator(),
             precision,
             DirectFactor::Part::all,
             DirectFactor::Entries::nonzero,
             &sections)
  {}



  void
  SectionPreconditioner::analyse(const BlockMatrix     &matrix,
                                 const Eigen::VectorXd &q)
  {
    sections.follow(q);
    factor.analyse(matrix);
  }



  void
  SectionPreconditioner::forget()
  {
    factor.forget();
  }



  int
  SectionPreconditioner::factorize(const BlockMatrix &matrix,
                                   const double       dropped)
  {
    this->matrix              = &matrix;
    const BlockLayout &layout = matrix.layout();
    compliances.resize(layout.owned_blocks().size());
    int n_soft = 0;
    for (unsigned int row = 0; row < compliances.size(); ++row)
      if (const unsigned int block = layout.owned_blocks()[row];
          sections.is_split(block))
        {
          const auto   &strains   = sections.strains(block);
          const Matrix3 stiffness = strains.transpose() *
                                    Eigen::Map<const RigidSections::Stiffness>(
                                      matrix.block(block, block)) *
                                    strains;
          const Eigen::LLT<Matrix3> cholesky(stiffness);
          n_soft += cholesky.info() != Eigen::Success;
          compliances[row] = cholesky.solve(Matrix3::Identity());
        }
    n_soft = dealii::Utilities::MPI::sum(n_soft, layout.communicator());
    const int negative_pivots = factor.factorize(matrix, dropped);
    return negative_pivots < 0 ? negative_pivots : negative_pivots + n_soft;
  }



  int
  SectionPreconditioner::ApplyInverse(const Epetra_MultiVector &x,
                                      Epetra_MultiVector       &y) const
  {
    const BlockLayout  &full   = matrix->layout();
    const BlockLayout  &motion = sections.layout();
    const unsigned int  n      = full.owned_blocks().size();
    std::vector<double> moves(motion.n_owned_dofs());
    Epetra_MultiVector  moved(x.Map(), 1), left(x.Map(), 1);
    const auto          node = [&](double *values, const unsigned int row) {
      return Eigen::Map<Node>(values + full.local_first_dof(row));
    };
    const auto move = [&](const unsigned int row) {
      return Eigen::Map<Eigen::Matrix<double, 6, 1>>(
        moves.data() + motion.local_first_dof(row));
    };
    const auto copy_all = [&](const unsigned int row, auto from, auto to) {
      std::copy_n(from, full.size(full.owned_blocks()[row]), to);
    };

    for (int v = 0; v < x.NumVectors(); ++v)
      {
        for (unsigned int row = 0; row < n; ++row)
          if (const unsigned int block = full.owned_blocks()[row];
              sections.is_split(block))
            move(row) = sections.motions(block).transpose() * node(x[v], row);
          else
            copy_all(row,
                     x[v] + full.local_first_dof(row),
                     moves.data() + motion.local_first_dof(row));
        factor.solve(motion, moves.data());
        for (unsigned int row = 0; row < n; ++row)
          if (const unsigned int block = full.owned_blocks()[row];
              sections.is_split(block))
            node(moved[0], row) = sections.motions(block) * move(row);
          else
            copy_all(row,
                     moves.data() + motion.local_first_dof(row),
                     moved[0] + full.local_first_dof(row));

        matrix->Apply(moved, left);
        left.Update(1, Epetra_MultiVector(View, x, v, 1), -1);
        for (unsigned int row = 0; row < n; ++row)
          if (const unsigned int block = full.owned_blocks()[row];
              sections.is_split(block))
            {
              const auto &strains = sections.strains(block);
              node(moved[0], row) +=
                strains *
                (compliances[row] * (strains.transpose() * node(left[0], row)));
            }
        std::copy_n(moved[0], moved.MyLength(), y[v]);
      }
    return 0;
  }
} // namespace fiberloom
