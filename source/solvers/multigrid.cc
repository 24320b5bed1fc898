// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>

#include <fiberloom/solvers/multigrid.h>

#include <Epetra_CrsMatrix.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace fiberloom
{
  namespace
  {
    // x0, r g1 and r g2 of a node, displacement and rotation of a body.
    constexpr int dofs_per_point = 3;

    /** Rows of dofs, which is what ML can coarsen. */
    std::unique_ptr<Epetra_CrsMatrix>
    copy_rows(const BlockMatrix &matrix)
    {
      const BlockLayout &layout = matrix.layout();
      const Epetra_Map  &rows   = matrix.OperatorRangeMap();
      std::vector<int>   entries;
      for (unsigned int row = 0; row < layout.owned_blocks().size(); ++row)
        {
          int width = 0;
          for (const unsigned int column : matrix.columns(row))
            width += layout.size(column);
          entries.insert(entries.end(),
                         layout.size(layout.owned_blocks()[row]),
                         width);
        }
      auto copy =
        std::make_unique<Epetra_CrsMatrix>(Copy, rows, entries.data(), true);

      std::vector<int>    columns;
      std::vector<double> values;
      for (unsigned int row = 0; row < layout.owned_blocks().size(); ++row)
        {
          columns.clear();
          for (const unsigned int block : matrix.columns(row))
            for (unsigned int j = 0; j < layout.size(block); ++j)
              columns.push_back(layout.first_dof(block) + j);
          const unsigned int block = layout.owned_blocks()[row];
          for (unsigned int i = 0; i < layout.size(block); ++i)
            {
              values.clear();
              for (unsigned int c = 0; c < matrix.columns(row).size(); ++c)
                {
                  const unsigned int width =
                    layout.size(matrix.columns(row)[c]);
                  const double *line = matrix.values(row, c) + i * width;
                  values.insert(values.end(), line, line + width);
                }
              copy->InsertGlobalValues(layout.first_dof(block) + i,
                                       columns.size(),
                                       values.data(),
                                       columns.data());
            }
        }
      copy->FillComplete();
      return copy;
    }
  } // namespace



  Multigrid::Multigrid(const RigidModes &rigid_modes)
  {
    for (const auto &mode : rigid_modes)
      modes.insert(modes.end(), mode.begin(), mode.end());
  }



  Multigrid::~Multigrid() = default;



  void
  Multigrid::build(const BlockMatrix &matrix)
  {
    hierarchy.reset();
    copy = copy_rows(matrix);

    Teuchos::ParameterList settings;
    ML_Epetra::SetDefaults("SA", settings);
    settings.set("ML output", 0);
    settings.set("PDE equations", dofs_per_point);
    settings.set("aggregation: type", "Uncoupled");
    settings.set("smoother: type", "Chebyshev");
    settings.set("smoother: sweeps", 2);
    settings.set("coarse: type", "Amesos-KLU");
    settings.set("null space: type", "pre-computed");
    settings.set("null space: dimension", int(RigidModes().size()));
    settings.set("null space: vectors", modes.data());
    hierarchy =
      std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*copy, settings);
    if (!hierarchy->IsPreconditionerComputed())
      throw StageFailure("the multigrid preconditioner could not be built");
  }



  Epetra_Operator &
  Multigrid::preconditioner()
  {
    return *hierarchy;
  }
} // namespace fiberloom
