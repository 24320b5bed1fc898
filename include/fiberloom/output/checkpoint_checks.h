// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_output_checkpoint_checks_h
#define fiberloom_output_checkpoint_checks_h

#include <fiberloom/output/checkpoint.h>

namespace fiberloom
{
  /**
   * Whether @p checkpoint can be a state of the fibers of @p mesh : sizes fit,
   * indices are those of what there is, numbers are finite and not beyond any
   * sample. A checksum tells that nothing was damaged on the way, not that a
   * sound program has written it. Throws InputError with what is wrong.
   */
  void
  check_checkpoint(const Checkpoint &checkpoint, const FiberMesh &mesh);
} // namespace fiberloom

#endif
