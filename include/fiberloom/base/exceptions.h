// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_exceptions_h
#define fiberloom_base_exceptions_h

#include <stdexcept>
#include <string>

namespace fiberloom
{
  /** Something in the input is wrong: one line for the user, exit status 1. */
  struct InputError : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** A stage cannot reach its end, or nothing can be written: status 2. */
  struct StageFailure : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** The run was asked to stop; a checkpoint is on disk: status 3. */
  struct StopRequested : std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /**
   * @p text for a screen: what would steer a terminal or is no UTF-8 as bytes,
   * such as \\x1b.
   */
  std::string
  printable(const std::string &text);

  /**
   * What @p exception says, on one printable line. Of deal.II's exceptions this
   * is the sentence that explains them, without place and stack trace; of
   * memory that is not to be had, how much was.
   */
  std::string
  one_line(const std::exception &exception);
} // namespace fiberloom

#endif
