// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_accuracy_h
#define fiberloom_base_accuracy_h

#include <fiberloom/base/given_text.h>

#include <optional>
#include <string>

namespace fiberloom
{
  /** Automatic values that go with an error of loading curves. */
  struct AccuracySettings
  {
    double elements_per_crossing; // of tows
    double elements_per_fiber;    // of fibers that form no fabric
    double largest_penetration;   // over the radius
    double stations_per_element;
    double contact_tolerance; // over the largest contact force
  };

  /** What the entry Accuracy may be, in words. */
  extern const std::string allowed_accuracies;

  /** The error of loading curves to aim at: "preview", "draft", "standard",
   * "fine", or a number with the sign, such as "2 %". */
  class Accuracy : public GivenText
  {
  public:
    Accuracy();

    Accuracy(const std::string &text);

    bool
    is_preview() const
    {
      return preview;
    }

    /**
     * The error in percent, for a preview that of a draft; nothing where the
     * text is another one or its number out of bounds.
     */
    const std::optional<double> &
    percent() const
    {
      return error;
    }

  private:
    bool                  preview;
    std::optional<double> error;
  };

  /**
   * The settings for an error between those of the table: by straight lines
   * between the logarithms. doc/accuracy.md has what was measured of its rows
   * for 10, 2 and 0.5 %; nothing is coarser than the first, and the one for 0.2
   * % goes on from them.
   */
  AccuracySettings
  settings_for(const double percent);
} // namespace fiberloom

#endif
