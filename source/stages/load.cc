// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the fiberloom authors

#include <fiberloom/base/exceptions.h>
#include <fiberloom/base/parameter_catalogue.h>
#include <fiberloom/base/parameters.h>

#include <fiberloom/contact/line_weights.h>

#include <fiberloom/coupling/hold.h>

#include <fiberloom/stages/coat_settings.h>
#include <fiberloom/stages/load.h>
#include <fiberloom/stages/matrix_borders.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace fiberloom
{
  namespace
  {
    Eigen::Quaterniond
    rotation_by(const Vector3 &vector)
    {
      const double angle = vector.norm();
      return angle > 0 ?
               Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle)) :
               Eigen::Quaterniond::Identity();
    }

    RigidBody
    body_of(const DriveParameters &drive)
    {
      return {drive.name, ~drive.free.bits<6>()};
    }

    /** A unit vector along @p function where it is longest, or 0. */
    Vector3
    main_direction(const VectorFunction &function, const double end)
    {
      const Vector3 largest = function.value(function.time_of_largest(end));
      return largest.norm() > 0 ? largest.normalized() : Vector3::Zero();
    }

    /** "0_at_0.5", for the name of a column. */
    std::string
    column_name(const FiberPoint &point)
    {
      std::string name = std::to_string(point.fiber) + "_" + point.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }

    /** A column for each component. */
    void
    add_vector(CurveRow &row, const Column &column, const Vector3 &value)
    {
      for (unsigned int c = 0; c < 3; ++c)
        {
          row.emplace_back(column, value[c]);
          row.back().first.name += name_of(static_cast<Component>(c));
        }
    }
  } // namespace



  StageType
  Load::type()
  {
    StageType type{"load",
                   "moves and loads the drives",
                   StageType::Sample::fibers_with_ends,
                   &make<Load>,
                   &make_settings<LoadSettings>};
    type.needs_drives     = true;
    type.moves_own_bodies = true;
    return type;
  }



  Load::Drive::Drive(const DriveParameters &parameters)
    : parameters(parameters)
    , translation(parameters.translation)
    , rotation(parameters.rotation)
    , force(parameters.force)
    , moment(parameters.moment)
  {}



  std::string
  Load::Drive::entry(const std::string &name) const
  {
    return "Drive " + parameters.name + "/" + name;
  }



  Load::Load(const Scene &scene)
    : Stage(scene)
    , settings(scene.parameters.stage_settings.get<LoadSettings>())
    , line_load(settings.line_load)
    , gravity(settings.gravity)
    , step(settings.largest_step)
  {
    const double end = settings.end;
    for (const DriveParameters &parameters : scene.parameters.drives)
      {
        drives.emplace_back(parameters);
        Drive &drive = drives.back();
        find_nodes(drive);
        if (scene.composite != nullptr)
          matrix_nodes(drive); // throws where there are none
        drive.direction = main_direction(drive.translation, end);
        if (drive.direction.isZero(0))
          drive.direction = main_direction(drive.force, end);
        step =
          drive.rotation.step_within(LoadSettings::largest_turn, step, end);
      }
    probes = find_points(settings.probes, scene.fibers);
    for (unsigned int d = 0; d < drives.size(); ++d)
      check_support(d);
    distribute_loads();
  }



  void
  Load::find_nodes(Drive &drive)
  {
    for (const FiberPoint &point :
         find_points(drive.parameters.ends, scene.fibers))
      {
        const auto &line = scene.mesh.lines()[point.fiber];
        drive.nodes.push_back(line.first_node + point.nearest_node());
        if (!point.is_node())
          snapped_points.push_back(
            "drive " + drive.parameters.name + ": fiber " +
            std::to_string(point.fiber) + " " + point.name +
            " is no node; the nearest one is held, " +
            std::to_string(point.nearest_node()) + " of 0 to " +
            std::to_string(line.n_nodes() - 1));
      }
  }



  Vector3
  Load::reference_point(const Drive &drive, const DofVector &q) const
  {
    if (const auto &center = drive.parameters.center.point())
      return *center;
    Vector3 sum = Vector3::Zero();
    for (const unsigned int node : drive.nodes)
      sum += q.segment<3>(9 * node);
    if (!drive.nodes.empty())
      return sum / drive.nodes.size();
    if (scene.composite == nullptr)
      return sum;
    const auto nodes = matrix_nodes(drive);
    for (const unsigned int node : nodes)
      sum += scene.composite->positions(q).segment<3>(3 * node);
    return sum / nodes.size();
  }



  std::vector<Attachment>
  Load::fiber_attachments(const unsigned int d, const DofVector &start) const
  {
    const Drive            &drive = drives[d];
    std::vector<Attachment> attachments;
    for (const unsigned int node : drive.nodes)
      attachments.push_back(drive.parameters.held.empty() ?
                              attach(start, node, d, drive.parameters.hold) :
                              attach(start,
                                     node,
                                     d,
                                     drive.parameters.held,
                                     reference_point(drive, start)));
    return attachments;
  }



  std::vector<unsigned int>
  Load::matrix_nodes(const Drive &drive) const
  {
    std::set<unsigned int> nodes;
    for (const MatrixBorder border : drive.parameters.matrix_borders.list())
      {
        const auto found = scene.composite->matrix().border_nodes(border);
        if (found.empty())
          throw InputError(
            scene.parameters.where(drive.entry("Matrix borders")) + ": the " +
            name_of(matrix_of(scene.parameters).layers) +
            " layers have no border " + name_of(border) +
            "; allowed: x start, x end, y start, y end, and where a layer lies "
            "bottom, top");
        nodes.insert(found.begin(), found.end());
      }
    return {nodes.begin(), nodes.end()};
  }



  Supports
  Load::supports(const DofVector &start) const
  {
    Supports supports;
    for (unsigned int d = 0; d < drives.size(); ++d)
      {
        supports.bodies.push_back(body_of(drives[d].parameters));
        for (const Attachment &attachment : fiber_attachments(d, start))
          supports.attachments.push_back(attachment);
      }
    if (scene.composite == nullptr)
      return supports;
    std::set<unsigned int> held; // an edge goes with the first of its drives
    for (unsigned int d = 0; d < drives.size(); ++d)
      for (const unsigned int node : matrix_nodes(drives[d]))
        if (held.insert(node).second)
          supports.attachments.push_back(
            MatrixBorders::attach(*scene.composite,
                                  node,
                                  d,
                                  drives[d].parameters.matrix_held.bits<3>()));
    return supports;
  }



  void
  Load::check_support(const unsigned int d) const
  {
    const DofVector &q     = scene.mesh.initial();
    const Drive     &drive = drives[d];
    if (!drive.parameters.matrix_borders.empty())
      return; // the matrix may hinder what fibers do not
    std::vector<Attachment> held;
    try
      {
        held = fiber_attachments(d, q);
      }
    catch (const InputError &error)
      {
        throw InputError(scene.parameters.where(drive.entry("Held")) + ": " +
                         error.what() + "; allowed: another Center, or tilt");
      }
    const BodyVector idle = idle_motion(body_of(drive.parameters),
                                        held,
                                        q,
                                        reference_point(drive, q));
    if (idle.isZero(0))
      return;
    BodyVector::Index largest;
    idle.cwiseAbs().maxCoeff(&largest);
    const std::string &dof = name_of(static_cast<BodyDof>(largest));
    throw InputError(scene.parameters.where(drive.entry("Free")) +
                     ": nothing that the drive holds hinders its motion "
                     "along " +
                     dof + "; allowed: leave " + dof + " out, or hold more");
  }



  void
  Load::distribute_loads()
  {
    const double end = settings.end;
    is_loaded        = !main_direction(line_load, end).isZero(0) ||
                !main_direction(gravity, end).isZero(0);
    if (!is_loaded)
      return;

    length_of_node.assign(scene.mesh.n_nodes(), 0.);
    mass_of_node.assign(scene.mesh.n_nodes(), 0.);
    // By the weights of contact, so that an even load is in balance with an
    // even pressure; they are not polynomials of an element.
    const dealii::QIterated<1> rule(dealii::QGauss<1>(4), 20);
    for (const unsigned int fiber :
         find_fibers(settings.loaded_fibers, scene.fibers))
      {
        const auto  &line = scene.mesh.lines()[fiber];
        const double mass_per_length =
          scene.fibers.fibers[fiber].density * M_PI * line.radius * line.radius;
        for (unsigned int e = 0; e < line.n_elements; ++e)
          for (unsigned int g = 0; g < rule.size(); ++g)
            {
              const ElementPoint point{line.first_element + e,
                                       2 * rule.point(g)[0] - 1};
              const LineWeights  weights(line, e + rule.point(g)[0]);
              const double       length =
                rule.weight(g) *
                scene.mesh.section(scene.mesh.reference(), point)
                  .center_derivative.norm();
              for (unsigned int a = 0; a < weights.n; ++a)
                {
                  const unsigned int node = weights.first_node + a;
                  length_of_node[node] += weights.value[a] * length;
                  mass_of_node[node] +=
                    weights.value[a] * length * mass_per_length;
                }
            }
      }
  }



  void
  Load::begin(State &state) const
  {
    state.placements.assign(drives.size(), Placement());
    for (unsigned int d = 0; d < drives.size(); ++d)
      state.placements[d].position = reference_point(drives[d], state.q);
  }



  Vector3
  Load::finite_value(const VectorFunction &function,
                     const double          t,
                     const std::string    &entry) const
  {
    const Vector3 value = function.value(t);
    if (!value.allFinite())
      throw StageFailure(scene.parameters.where(entry) +
                         " is not finite at t = " + exact_text(t));
    return value;
  }



  std::vector<BodyTarget>
  Load::targets(const std::vector<Placement> &start, const double load) const
  {
    const double            t = load * settings.end;
    std::vector<BodyTarget> targets(start.size());
    for (unsigned int d = 0; d < start.size(); ++d)
      {
        const Drive &drive  = drives[d];
        Placement   &target = targets[d].placement;
        const auto   at     = [&](const VectorFunction &function,
                            const std::string    &name) {
          return finite_value(function, t, drive.entry(name));
        };
        target.position =
          start[d].position + at(drive.translation, "Translation");
        target.rotation =
          rotation_by(at(drive.rotation, "Rotation")) * start[d].rotation;
        targets[d].load << at(drive.force, "Force"), at(drive.moment, "Moment");
      }
    return targets;
  }



  std::vector<Vector3>
  Load::node_forces(const double load) const
  {
    if (!is_loaded)
      return {};
    const double  t          = load * settings.end;
    const Vector3 per_length = finite_value(line_load, t, "Load/Line load");
    const Vector3 per_mass   = finite_value(gravity, t, "Load/Gravity");
    std::vector<Vector3> forces;
    for (unsigned int n = 0; n < length_of_node.size(); ++n)
      forces.push_back(length_of_node[n] * per_length +
                       mass_of_node[n] * per_mass);
    return forces;
  }



  double
  Load::first_step(const State &) const
  {
    return std::min(settings.first_step, step) / settings.end;
  }



  double
  Load::largest_step() const
  {
    return step / settings.end;
  }



  double
  Load::next_stop(const double load) const
  {
    const double end = settings.end;
    return std::min(1., (std::floor(load * end + 1e-9) + 1) / end);
  }



  CurveRow
  Load::curve(const State                   &state,
              const std::vector<BodyVector> &reactions) const
  {
    const auto is_directed = [](const Drive &drive) {
      return !drive.direction.isZero(0);
    };
    const bool any_directed =
      std::any_of(drives.begin(), drives.end(), is_directed);
    CurveRow row{{{"t", Quantity::number}, state.load * settings.end}};
    for (unsigned int d = 0; d < drives.size(); ++d)
      {
        const std::string name  = drives[d].parameters.name + "_";
        const Vector3     force = reactions[d].head<3>();
        add_vector(row,
                   {name, Quantity::length, Role::deformation},
                   state.placements[d].position);
        add_vector(row,
                   {name + "r", Quantity::angle, Role::deformation},
                   state.placements[d].turn);
        add_vector(row,
                   {name + "force_",
                    Quantity::force,
                    any_directed ? Role::detail : Role::response},
                   force);
        add_vector(row,
                   {name + "moment_", Quantity::moment, Role::response},
                   reactions[d].tail<3>());
        if (is_directed(drives[d]))
          row.push_back({{"force_" + drives[d].parameters.name,
                          Quantity::force,
                          Role::response},
                         force.dot(drives[d].direction)});
      }
    for (const FiberPoint &probe : probes)
      add_vector(row,
                 {"probe_" + column_name(probe) + "_", Quantity::length},
                 scene.mesh
                   .section(state.q,
                            scene.mesh.locate(probe.fiber, probe.position / 2))
                   .center);
    return row;
  }
} // namespace fiberloom
