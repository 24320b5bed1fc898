// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/stage_type.h>

#include <algorithm>

namespace fiberloom
{
  const StageType &
  stage_type(const std::string &name)
  {
    const auto type = std::find_if(stage_types().begin(),
                                   stage_types().end(),
                                   [&name](const StageType &known) {
                                     return known.name == name;
                                   });
    if (type == stage_types().end())
      throw InputError("Stages: \"" + name + "\" is unknown; there are " +
                       stage_names());
    return *type;
  }



  bool
  is_stage(const std::string &name, bool StageType::*that)
  {
    return std::any_of(stage_types().begin(),
                       stage_types().end(),
                       [&](const StageType &known) {
                         return known.name == name && known.*that;
                       });
  }



  std::string
  stage_names(const std::function<bool(const StageType &)> &is_meant)
  {
    std::string names;
    for (const StageType &type : stage_types())
      if (is_meant(type))
        names += (names.empty() ? "" : ", ") + type.name;
    return names;
  }



  AllStageSettings::AllStageSettings()
  {
    for (const StageType &type : stage_types())
      if (type.settings)
        items.push_back({type.name, type.settings()});
  }



  AllStageSettings::AllStageSettings(const AllStageSettings &other)
  {
    for (const Item &item : other.items)
      items.push_back({item.type, item.settings->clone()});
  }



  AllStageSettings &
  AllStageSettings::operator=(const AllStageSettings &other)
  {
    AllStageSettings copy(other);
    items.swap(copy.items);
    return *this;
  }



  const StageSettings *
  AllStageSettings::find(const std::string &type) const
  {
    for (const Item &item : items)
      if (item.type == type)
        return item.settings.get();
    return nullptr;
  }



  void
  AllStageSettings::declare(ParameterCatalogue &catalogue)
  {
    for (const Item &item : items)
      item.settings->declare(catalogue);
  }



  void
  AllStageSettings::resolve(const Parameters &parameters)
  {
    for (const Item &item : items)
      item.settings->resolve(parameters);
  }



  void
  AllStageSettings::check(const Parameters &parameters) const
  {
    for (const Item &item : items)
      item.settings->check(parameters);
  }



  void
  AllStageSettings::check_fibers(const Parameters &parameters,
                                 const FiberSet   &fibers) const
  {
    for (const Item &item : items)
      item.settings->check_fibers(parameters, fibers);
  }



  bool
  AllStageSettings::describe_matrix() const
  {
    return std::any_of(items.begin(), items.end(), [](const Item &item) {
      return item.settings->describes_matrix();
    });
  }



  std::vector<std::string>
  AllStageSettings::notes(const Parameters &parameters) const
  {
    std::vector<std::string> all;
    for (const Item &item : items)
      for (const std::string &note : item.settings->notes(parameters))
        all.push_back(note);
    return all;
  }
} // namespace fiberloom
