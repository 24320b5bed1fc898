// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_scoped_timer_h
#define fiberloom_base_scoped_timer_h

#include <chrono>

namespace fiberloom
{
  /** Adds the seconds of its life to a counter. */
  class ScopedTimer
  {
  public:
    explicit ScopedTimer(double &seconds)
      : seconds(seconds)
      , start(std::chrono::steady_clock::now())
    {}

    ScopedTimer(const ScopedTimer &) = delete;

    ~ScopedTimer()
    {
      seconds += elapsed();
    }

    /** Of its life so far [s]. */
    double
    elapsed() const
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                           start)
        .count();
    }

  private:
    double                                     &seconds;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace fiberloom

#endif
