// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/coupling/hold.h>

#include <fiberloom/stages/load.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace fiberloom
{
  /** Three components each of translation, rotation, force and moment. */
  class DriveFunctions
  {
  public:
    explicit DriveFunctions(const DriveParameters &drive)
    {
      const std::array<const std::string *, 4> texts{
        {&drive.translation, &drive.rotation, &drive.force, &drive.moment}};
      const std::map<std::string, double> constants{{"pi", M_PI}};
      for (unsigned int k = 0; k < 4; ++k)
        {
          parsed[k] = std::make_unique<dealii::FunctionParser<1>>(3);
          parsed[k]->initialize("t", *texts[k], constants);
        }
    }

    Vector3
    translation(const double t) const
    {
      return value(0, t);
    }

    Eigen::Quaterniond
    rotation(const double t) const
    {
      const Vector3 vector = value(1, t);
      const double  angle  = vector.norm();
      return angle > 0 ?
               Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle)) :
               Eigen::Quaterniond::Identity();
    }

    BodyVector
    load(const double t) const
    {
      BodyVector load;
      load << value(2, t), value(3, t);
      return load;
    }

  private:
    Vector3
    value(const unsigned int k, const double t) const
    {
      Vector3 v;
      for (unsigned int c = 0; c < 3; ++c)
        v[c] = parsed[k]->value(dealii::Point<1>(t), c);
      return v;
    }

    std::array<std::unique_ptr<dealii::FunctionParser<1>>, 4> parsed;
  };



  namespace
  {
    std::vector<unsigned int>
    find_nodes(const DriveParameters &drive, const FiberMesh &mesh)
    {
      std::vector<unsigned int> nodes;
      for (const std::string &item :
           dealii::Utilities::split_string_list(drive.ends, ','))
        {
          std::istringstream text(item);
          unsigned int       fiber;
          std::string        end;
          if (!(text >> fiber >> end) || fiber >= mesh.lines().size())
            throw InputError("Drive " + drive.name + "/Ends: \"" + item +
                             "\" names no fiber end of this scene");
          const auto &line = mesh.lines()[fiber];
          nodes.push_back(line.first_node +
                          (end == "start" ? 0 : line.n_nodes() - 1));
        }
      return nodes;
    }

    Hold
    find_hold(const std::string &name)
    {
      return name == "clamped" ? Hold::clamped :
             name == "pinned"  ? Hold::pinned :
                                 Hold::center;
    }
  } // namespace



  Load::Load(const Scene &scene)
    : Stage(scene)
  {
    std::vector<unsigned int> all;
    for (const DriveParameters &drive : scene.parameters.drives)
      {
        held_nodes.push_back(find_nodes(drive, scene.mesh));
        functions.push_back(std::make_unique<DriveFunctions>(drive));
        all.insert(all.end(),
                   held_nodes.back().begin(),
                   held_nodes.back().end());
      }
    std::sort(all.begin(), all.end());
    if (std::adjacent_find(all.begin(), all.end()) != all.end())
      throw InputError("Drives: a fiber end is held by two drives");
  }



  Load::~Load() = default;



  Supports
  Load::supports() const
  {
    static const std::vector<std::string> names{
      "x", "y", "z", "rx", "ry", "rz"};
    Supports supports;
    for (unsigned int d = 0; d < held_nodes.size(); ++d)
      {
        const DriveParameters &drive = scene.parameters.drives[d];
        RigidBody              body;
        body.name = drive.name;
        std::istringstream text(drive.free);
        for (std::string word; text >> word;)
          body.prescribed[std::find(names.begin(), names.end(), word) -
                          names.begin()] = false;
        for (const unsigned int node : held_nodes[d])
          supports.attachments.push_back(
            attach(scene.mesh.initial(), node, d, find_hold(drive.hold)));
        supports.bodies.push_back(body);
      }
    return supports;
  }



  void
  Load::begin(State &state, Equilibrium &) const
  {
    state.placements.assign(held_nodes.size(), Placement());
    for (unsigned int d = 0; d < held_nodes.size(); ++d)
      {
        Vector3 mean = Vector3::Zero();
        for (const unsigned int node : held_nodes[d])
          mean += state.q.segment<3>(9 * node);
        state.placements[d].position = mean / held_nodes[d].size();
      }
  }



  std::vector<BodyTarget>
  Load::targets(const std::vector<Placement> &start, const double load) const
  {
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int d = 0; d < start.size(); ++d)
      {
        targets[d].placement = start[d];
        targets[d].placement.position += functions[d]->translation(load);
        targets[d].placement.rotation =
          functions[d]->rotation(load) * start[d].rotation;
        targets[d].load = functions[d]->load(load);
      }
    return targets;
  }



  ContactRule
  Load::rule(const double) const
  {
    ContactRule rule;
    rule.friction = scene.parameters.contact.friction_coefficient > 0;
    return rule;
  }



  double
  Load::first_step(const State &) const
  {
    return std::min(scene.parameters.load.first_step,
                    scene.parameters.load.largest_step);
  }



  double
  Load::largest_step() const
  {
    return scene.parameters.load.largest_step;
  }



  CurveRow
  Load::curve(const State                   &state,
              const std::vector<BodyVector> &reactions) const
  {
    static const std::array<std::string, 3> axes{{"x", "y", "z"}};
    CurveRow                                row;
    for (unsigned int d = 0; d < held_nodes.size(); ++d)
      {
        const std::string &name = scene.parameters.drives[d].name;
        for (unsigned int c = 0; c < 3; ++c)
          row.emplace_back(name + "_" + axes[c] + "[mm]",
                           state.placements[d].position[c]);
        for (unsigned int c = 0; c < 3; ++c)
          row.emplace_back(name + "_force_" + axes[c] + "[N]", reactions[d][c]);
        for (unsigned int c = 0; c < 3; ++c)
          row.emplace_back(name + "_moment_" + axes[c] + "[N.mm]",
                           reactions[d][3 + c]);
      }
    return row;
  }
} // namespace fiberloom
