// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_checkpoint_h
#define fiberloom_output_checkpoint_h

#include <fiberloom/base/run_identity.h>
#include <fiberloom/base/statistics.h>

#include <fiberloom/fabric/fiber_set.h>

#include <fiberloom/beams/fiber_mesh.h>

#include <fiberloom/model/state.h>

#include <fiberloom/stages/column.h>

#include <fiberloom/output/fields.h>

#include <mpi.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace fiberloom
{
  /**
   * What the output directory holds of a run. A restart takes it from here, not
   * from the files, which may be those of another run or of later increments.
   */
  struct OutputRecord
  {
    std::map<std::string, std::string>          tables;       // text by file
    std::vector<Column>                         columns;      // of the curve
    std::map<std::string, FieldSeries::Entries> fields;       // by series
    std::uint64_t                               log_size = 0; // [bytes]
  };

  /** All that a run needs to go on as if it had never stopped. */
  struct Checkpoint
  {
    State                        state;
    std::vector<StageStatistics> stages; // done or under way
    RunIdentity                  run;
    OutputRecord                 output;
  };

  /**
   * Sizes of a model and a checksum of its geometry, materials and, for a
   * fabric, the superimposition order of all crossings: two models with the
   * same description can use each other's checkpoints.
   */
  std::string
  describe_model(const FiberSet &fibers, const FiberMesh &mesh);

  /** Content of a checkpoint file for the model described by @p model . */
  std::string
  encode_checkpoint(const Checkpoint &checkpoint, const std::string &model);

  /**
   * The reverse. Throws InputError with one line that starts with @p file when
   * the content is damaged, of another version or of another model.
   */
  Checkpoint
  decode_checkpoint(const std::string &content,
                    const std::string &model,
                    const std::string &file);

  /**
   * Rank 0 writes; the old file stays until the new one is safely on the
   * disk. Throws StageFailure on all ranks. Collective.
   */
  void
  write_checkpoint(const std::string &file,
                   const Checkpoint  &checkpoint,
                   const std::string &model,
                   const MPI_Comm     comm);

  /** Rank 0 reads. Throws InputError on all ranks. Collective. */
  Checkpoint
  read_checkpoint(const std::string &file,
                  const std::string &model,
                  const MPI_Comm     comm);
} // namespace fiberloom

#endif
