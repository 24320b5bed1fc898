// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#ifndef fiberloom_base_stage_type_h
#define fiberloom_base_stage_type_h

#include <functional>
#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

namespace fiberloom
{
  class ParameterCatalogue;
  class Stage;
  struct FiberSet;
  struct Parameters;
  struct Scene;

  /** What the user sets of one type of stage: a section of the parameter file.
   */
  class StageSettings
  {
  public:
    virtual ~StageSettings() = default;

    /** A copy of the derived type. */
    virtual std::unique_ptr<StageSettings>
    clone() const = 0;

    /** Declares all entries; parsing @p catalogue fills them. */
    virtual void
    declare(ParameterCatalogue &catalogue) = 0;

    /** Gives automatic entries their values, and makes those fit each other
     * that a user need not fit; called when what does not belong to a stage is
     * resolved. */
    virtual void
    resolve(const Parameters & /*parameters*/)
    {}

    /**
     * Throws InputError for what is wrong of them, whether or not @p parameters
     * have such a stage.
     */
    virtual void
    check(const Parameters &parameters) const = 0;

    /** Throws InputError for what does not go with the fibers of the scene. */
    virtual void
    check_fibers(const Parameters & /*parameters*/,
                 const FiberSet & /*fibers*/) const
    {}

    /** Notes on what is no fault, but what the user should know. */
    virtual std::vector<std::string>
    notes(const Parameters & /*parameters*/) const
    {
      return {};
    }

    /** Whether the periods of a cell stay at right angles. */
    virtual bool
    keeps_right_angles() const
    {
      return true;
    }

    /** Whether a matrix is described. */
    virtual bool
    describes_matrix() const
    {
      return false;
    }
  };

  /** Settings that can be copied. */
  template <class Settings>
  class CopyableSettings : public StageSettings
  {
  public:
    std::unique_ptr<StageSettings>
    clone() const override
    {
      return std::make_unique<Settings>(static_cast<const Settings &>(*this));
    }
  };

  /** Creates default settings of this type, for StageType::settings. */
  template <class Settings>
  std::unique_ptr<StageSettings>
  make_settings()
  {
    return std::make_unique<Settings>();
  }

  /** A type of stage, as far as input is concerned. */
  struct StageType
  {
    /** The samples on which a type of stage can be run. */
    enum class Sample
    {
      fibers, // any
      fibers_with_ends,
      fabric, // or cell
      fabric_with_ends,
      cell
    };

    std::string name;    // in the entry Stages
    std::string summary; // what it does, in a few words after the name
    Sample      sample;
    std::function<std::unique_ptr<Stage>(const Scene &)> create;
    std::function<std::unique_ptr<StageSettings>()>      settings; // or none

    // What other stages and the program have to know of it.
    bool starts_fabric    = false; // from flat tows: it is the first one
    bool adds_matrix      = false;
    bool needs_no_matrix  = false;
    bool needs_drives     = false;
    bool only_relaxes     = false; // it leaves a fabric at rest, untested
    bool moves_own_bodies = false; // other ones than tow ends

    bool
    needs_fabric() const
    {
      return sample != Sample::fibers && sample != Sample::fibers_with_ends;
    }

    bool
    needs_ends() const
    {
      return sample == Sample::fibers_with_ends ||
             sample == Sample::fabric_with_ends;
    }

    bool
    needs_cell() const
    {
      return sample == Sample::cell;
    }
  };

  /**
   * All types there are, in the order in which a user reads them; what lists
   * them stands beside the stages.
   */
  const std::vector<StageType> &
  stage_types();

  /** The type that has this name. Throws InputError where there is none. */
  const StageType &
  stage_type(const std::string &name);

  /**
   * Whether the type @p name has the property @p that , such as
   * &StageType::adds_matrix; false for an unknown name, as a file of another
   * version may have.
   */
  bool
  is_stage(const std::string &name, bool StageType::*that);

  /**
   * Names of the types for which @p is_meant , such as "weave, relax, coat".
   */
  std::string
  stage_names(const std::function<bool(const StageType &)> &is_meant =
                [](const StageType &) { return true; });

  /** The settings of all types that have some, at first the default ones.
   * Copies are deep. */
  class AllStageSettings
  {
  public:
    AllStageSettings();

    AllStageSettings(const AllStageSettings &other);

    AllStageSettings &
    operator=(const AllStageSettings &other);

    /** The settings of this type. Throws std::bad_cast where there are none. */
    template <class Settings>
    Settings &
    get()
    {
      for (const Item &item : items)
        if (auto *settings = dynamic_cast<Settings *>(item.settings.get()))
          return *settings;
      throw std::bad_cast();
    }

    template <class Settings>
    const Settings &
    get() const
    {
      return const_cast<AllStageSettings *>(this)->get<Settings>();
    }

    /** The settings of @p type ; null where it has none. */
    const StageSettings *
    find(const std::string &type) const;

    /**
     * Declares the entries of all settings. The functions below do for all what
     * those of StageSettings do for one.
     */
    void
    declare(ParameterCatalogue &catalogue);

    void
    resolve(const Parameters &parameters);

    void
    check(const Parameters &parameters) const;

    void
    check_fibers(const Parameters &parameters, const FiberSet &fibers) const;

    /** Whether the settings of any type describe a matrix. */
    bool
    describe_matrix() const;

    std::vector<std::string>
    notes(const Parameters &parameters) const;

  private:
    struct Item
    {
      std::string                    type;
      std::unique_ptr<StageSettings> settings;
    };

    std::vector<Item> items;
  };
} // namespace fiberloom

#endif
