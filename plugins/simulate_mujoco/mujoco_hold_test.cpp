#include "mujoco_hold_test.h"

#include "handway/planning/edits/scene_edits.h"
#include "handway/planning/extensions/plugin.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>

namespace handway::simulate_mujoco {
namespace {

using Eigen::Vector3d;
using geometric::Pose;
using planning::HoldConditions;
using planning::HoldResult;
using planning::HoldSlip;

constexpr double kGravity = 9.81;         // m/s²
constexpr double kSqueezeTime = 0.5;      // s
constexpr double kFrameTime = 0.02;       // s between those that are watched
constexpr double kClosingTime = 1.0;      // s, onto a misplaced object
constexpr double kDisturbanceTime = 1.5;  // s, of each force
constexpr double kSettled = 0.25;         // s under a steady load, before it is cut short
constexpr double kLiftTime = 1.0;         // s
constexpr double kLiftHeight = 0.1;       // m
constexpr double kLiftHoldTime = 5.0;     // s

/// Acts on the object during a load.
struct Load {
  Vector3d force = Vector3d::Zero();         ///< N, at the centre of mass, in the palm's frame.
  Vector3d acceleration = Vector3d::Zero();  ///< m/s², of everything, in the palm's frame.
  Vector3d turning = Vector3d::Zero();       ///< rad/s: angular velocity of the palm, in its frame.
  Vector3d turning_up = Vector3d::Zero();    ///< rad/s²: its derivative.
};
/// The load at a time (s) from its begin.
using LoadAtTime = std::function<Load(double time)>;

/// The inertial forces of a motion of the palm, and gravity, by differences of its poses.
class MotionLoads {
 public:
  explicit MotionLoads(const planning::PalmMotion& motion) : motion_(motion) {}

  [[nodiscard]] double duration() const {
    return motion_.period * static_cast<double>(motion_.X_WP.size() - 1);
  }

  [[nodiscard]] Load at(double time) const {
    const auto i = static_cast<std::ptrdiff_t>(std::lround(time / motion_.period));
    const Eigen::Matrix3d R_PW = pose(i).linear().transpose();
    const Vector3d acceleration =
        (pose(i + 1).translation() - 2.0 * pose(i).translation() + pose(i - 1).translation()) /
        (motion_.period * motion_.period);
    const Vector3d before = turn(i - 1);
    const Vector3d after = turn(i);
    return {Vector3d::Zero(), -R_PW * (acceleration + Vector3d(0.0, 0.0, kGravity)),
            0.5 * (before + after), (after - before) / motion_.period};
  }

 private:
  // The palm rests before and after the motion.
  [[nodiscard]] const Pose& pose(std::ptrdiff_t i) const {
    const auto last = static_cast<std::ptrdiff_t>(motion_.X_WP.size()) - 1;
    return motion_.X_WP[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
  }

  // Mean angular velocity from pose i to the next, in the palm's frame, rad/s.
  [[nodiscard]] Vector3d turn(std::ptrdiff_t i) const {
    const Eigen::AngleAxisd turned(pose(i).linear().transpose() * pose(i + 1).linear());
    return turned.angle() / motion_.period * turned.axis();
  }

  const planning::PalmMotion& motion_;
};

// Acceleration (m/s²) of a motion over a height, from rest to rest with the least jerk.
double lift_acceleration(double time) {
  const double s = time / kLiftTime;
  return s >= 1.0 ? 0.0
                  : kLiftHeight / (kLiftTime * kLiftTime) *
                        (60.0 * s - 180.0 * s * s + 120.0 * s * s * s);
}

void set_conditions(const HandModel& hand, const HoldConditions& conditions, mjModel& model) {
  for (int geom = 0; geom < model.ngeom; ++geom) {
    mjtNum* friction = model.geom_friction + 3 * geom;
    friction[0] = conditions.contact.friction;
    friction[1] = conditions.contact.torsion();  // m: torque over normal force
  }
  const mjtNum ratio = conditions.mass / model.body_mass[hand.object_body];
  model.body_mass[hand.object_body] *= ratio;
  for (int axis = 0; axis < 3; ++axis) {
    model.body_inertia[3 * hand.object_body + axis] *= ratio;
  }
  const auto drive = [&](int actuator, double stiffness, double limit) {
    model.actuator_gainprm[mjNGAIN * actuator] = stiffness;
    model.actuator_biasprm[mjNBIAS * actuator + 1] = -stiffness;
    model.actuator_forcelimited[actuator] = 1;
    model.actuator_forcerange[2 * actuator] = -limit;
    model.actuator_forcerange[2 * actuator + 1] = limit;
  };
  for (const int actuator : hand.rotations) {
    drive(actuator, conditions.stiffness, conditions.torque);
  }
  for (const int actuator : hand.slides) {
    drive(actuator, conditions.slide_stiffness, conditions.slide_force);
  }
}

/// One grasp in simulation.
class Simulation {
 public:
  Simulation(const HandModel& hand, const geometric::RobotModel& robot,
             const planning::Pregrasp& grasp, const Pose& X_WP, const Pose& X_WO,
             const HoldConditions& conditions, std::stop_token stop,
             const planning::HoldWatcher& watch)
      : hand_(hand),
        robot_(robot),
        grasp_(grasp),
        X_WP_(X_WP),
        conditions_(conditions),
        stop_(std::move(stop)),
        watch_(watch),
        model_(mj_copyModel(nullptr, hand.model.get())),
        data_(make_data(*model_)),
        squeezed_(make_data(*model_)) {
    set_conditions(hand_, conditions_, *model_);
    mj_setConst(model_.get(), data_.get());
    mj_resetData(model_.get(), data_.get());
    place_object(X_WP.inverse() * X_WO);
    set_posture(grasp.closed);
    if (!conditions.misplacement.isZero()) {
      open();
    }
    grasp_pose_ = squeezed_pose_ = object_pose();
  }

  [[nodiscard]] HoldSlip squeeze() {
    const double duration = conditions_.misplacement.isZero() ? kSqueezeTime : kClosingTime;
    const HoldSlip slip = run(duration, duration, [&](double time) {
      set_targets(std::min(1.0, 2.0 * time / duration));
      return Load{};
    });
    squeezed_pose_ = object_pose();
    mj_copyData(squeezed_.get(), model_.get(), data_.get());
    return slip;
  }

  // The load begins with the end of the squeeze.
  // @param settled as run().
  [[nodiscard]] HoldSlip load(double duration, double settled, const LoadAtTime& load_at) {
    mj_copyData(data_.get(), model_.get(), squeezed_.get());
    ++load_;
    return run(duration, settled, load_at);
  }

  // Carries the object after the squeeze.
  [[nodiscard]] planning::CarryResult carry(const planning::PalmMotion& motion) {
    planning::CarryResult result;
    result.squeeze = squeeze();
    const MotionLoads loads(motion);
    largest_forces_.assign(static_cast<std::size_t>(model_->nbody), 0.0);
    const double duration = loads.duration() + kSettled;
    result.slip = load(duration, duration, [&](double time) { return loads.at(time); });
    result.time = std::min(elapsed_, loads.duration());
    for (int link = 0; link < robot_.link_count(); ++link) {
      const int body = mj_name2id(model_.get(), mjOBJ_BODY, body_name(link).c_str());
      if (body >= 0 && largest_forces_[static_cast<std::size_t>(body)] > 0.0) {
        result.forces.push_back(
            {robot_.link(link).name, largest_forces_[static_cast<std::size_t>(body)]});
      }
    }
    result.torque_share = largest_torque_;
    if (strongest_ >= 0) {
      result.joint = robot_.joint(strongest_).name;
    }
    return result;
  }

 private:
  // Notes the largest forces on the object, and the largest torque of a joint, while the object is
  // carried.
  void note_forces() {
    if (largest_forces_.empty()) {
      return;
    }
    std::vector<double> forces(largest_forces_.size(), 0.0);
    for (int contact = 0; contact < data_->ncon; ++contact) {
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model_.get(), data_.get(), contact, wrench.data());
      for (const int geom : {data_->contact[contact].geom1, data_->contact[contact].geom2}) {
        forces[static_cast<std::size_t>(model_->geom_bodyid[geom])] += wrench[0];
      }
    }
    for (std::size_t body = 0; body < forces.size(); ++body) {
      largest_forces_[body] = std::max(largest_forces_[body], forces[body]);
    }
    for (const HandJoint& joint : hand_.joints) {
      if (joint.actuator < 0) {
        continue;
      }
      const double share = std::abs(data_->actuator_force[joint.actuator]) /
                           model_->actuator_forcerange[2 * joint.actuator + 1];
      if (share > largest_torque_) {
        largest_torque_ = share;
        strongest_ = joint.link;
      }
    }
  }

  void place_object(const Pose& X_PO) {
    mjtNum* object = data_->qpos + hand_.object_position;
    const Eigen::Quaterniond q(X_PO.linear());
    std::copy_n(X_PO.translation().data(), 3, object);
    object[3] = q.w();
    object[4] = q.x();
    object[5] = q.y();
    object[6] = q.z();
  }

  void set_posture(const planning::Configuration& q) {
    begin_ = q;
    for (const HandJoint& joint : hand_.joints) {
      data_->qpos[joint.position] = geometric::joint_value(robot_, joint.link, q);
    }
    set_targets(0.0);
    mj_forward(model_.get(), data_.get());
  }

  // Opens the hand against the direction of its squeeze until nothing touches the object, or as far
  // as the joints go.
  void open() {
    constexpr int kSteps = 30;
    constexpr double kMost = 1.5;  // rad or m of the joint that moves most
    const Eigen::VectorXd squeeze = grasp_.squeezed - grasp_.closed;
    const double most = squeeze.cwiseAbs().maxCoeff();
    for (int step = 1; step <= kSteps && most > 0.0 && data_->ncon > 0; ++step) {
      set_posture(robot_.clamped(grasp_.closed - squeeze * (kMost * step / (kSteps * most))));
    }
  }

  // Targets on the way from the begin (0) to the squeeze (1).
  void set_targets(double share) {
    const planning::Configuration q = begin_ + share * (grasp_.squeezed - begin_);
    for (const HandJoint& joint : hand_.joints) {
      if (joint.actuator >= 0) {
        data_->ctrl[joint.actuator] = geometric::joint_value(robot_, joint.link, q);
      }
    }
  }

  [[nodiscard]] Pose object_pose() const {
    const mjtNum* object = data_->qpos + hand_.object_position;
    Pose X = Pose::Identity();
    X.translation() = Vector3d(object[0], object[1], object[2]);
    X.linear() = Eigen::Quaterniond(object[3], object[4], object[5], object[6])
                     .normalized()
                     .toRotationMatrix();
    return X;
  }

  // The turn is that of the object's frame, the shift that of its centre of mass.
  [[nodiscard]] HoldSlip moved_from(const Pose& before) const {
    const Pose now = object_pose();
    const Vector3d centre(model_->body_ipos + 3 * hand_.object_body);
    const double turn = Eigen::AngleAxisd(before.linear().transpose() * now.linear()).angle();
    const double shift = (now * centre - before * centre).norm();
    const bool stable = data_->warning[mjWARN_BADQPOS].number == 0 &&
                        data_->warning[mjWARN_BADQVEL].number == 0 &&
                        data_->warning[mjWARN_BADQACC].number == 0;
    return {stable && shift <= conditions_.largest_shift && turn <= conditions_.largest_turn, shift,
            turn};
  }

  // The slip after some more time (s) at the object's present speed.
  [[nodiscard]] HoldSlip ahead(const HoldSlip& moved, double time) const {
    const mjtNum* v = data_->qvel + model_->body_dofadr[hand_.object_body];
    return {moved.held, moved.shift + time * Vector3d(v[0], v[1], v[2]).norm(),
            moved.turn + time * Vector3d(v[3], v[4], v[5]).norm()};
  }

  // Returns whether the object would stay within the limits at twice that slip.
  [[nodiscard]] bool is_safe(const HoldSlip& slip) const {
    return 2.0 * slip.shift < conditions_.largest_shift &&
           2.0 * slip.turn < conditions_.largest_turn;
  }

  // @param settled s, from when on the load stays the same: what is left of the time is then taken
  // to pass at the object's present speed, as soon as twice that much slip would not matter.
  [[nodiscard]] HoldSlip run(double duration, double settled, const LoadAtTime& load_at) {
    const double step_time = model_->opt.timestep;
    const int steps = static_cast<int>(std::lround(duration / step_time));
    constexpr int kLook = 25;  // steps
    const int per_frame = std::max(1, static_cast<int>(std::lround(kFrameTime / step_time)));
    HoldSlip from_grasp{true, 0.0, 0.0};
    int step = 0;
    while (step < steps && from_grasp.held && !stop_.stop_requested()) {
      if (watch_ && step % per_frame == 0) {
        watch_(frame(step * step_time));
      }
      apply(load_at(step * step_time));
      mj_step(model_.get(), data_.get());
      note_forces();
      ++step;
      if (step % kLook == 0 || step == steps) {
        from_grasp = moved_from(grasp_pose_);
        if (step * step_time > settled && is_safe(ahead(from_grasp, (steps - step) * step_time))) {
          break;
        }
      }
    }
    elapsed_ = step * step_time;
    const HoldSlip slip = moved_from(squeezed_pose_);
    return from_grasp.held ? ahead(slip, (steps - step) * step_time)
                           : HoldSlip{false, slip.shift, slip.turn};
  }

  [[nodiscard]] planning::HoldFrame frame(double time) const {
    planning::HoldFrame frame{load_, time, grasp_.closed, X_WP_ * object_pose(), contact_forces()};
    for (const HandJoint& joint : hand_.joints) {
      if (joint.actuator >= 0) {
        frame.q[robot_.mimic_mapping(joint.link).variable] = data_->qpos[joint.position];
      }
    }
    return frame;
  }

  // Contacts are between the hand and the object only.
  [[nodiscard]] std::vector<planning::ContactForce> contact_forces() const {
    using Axes = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    std::vector<planning::ContactForce> forces;
    for (int i = 0; i < data_->ncon; ++i) {
      const mjContact& contact = data_->contact[i];
      std::array<mjtNum, 6> wrench{};
      mj_contactForce(model_.get(), data_.get(), i, wrench.data());
      // MuJoCo's force acts on the second body, in axes whose first is the normal.
      const Vector3d force_P = Eigen::Map<const Axes>(contact.frame).transpose() *
                               Eigen::Map<const Vector3d>(wrench.data());
      const bool is_second = model_->geom_bodyid[contact.geom2] == hand_.object_body;
      forces.push_back({X_WP_ * Vector3d(contact.pos),
                        X_WP_.linear() * (is_second ? force_P : Vector3d(-force_P))});
    }
    return forces;
  }

  void apply(const Load& load) {
    const int body = hand_.object_body;
    const Vector3d& w = load.turning;
    const Vector3d centre(data_->xipos + 3 * body);
    const Vector3d v(data_->qvel + model_->body_dofadr[body]);
    const Eigen::Matrix3d axes =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->ximat + 9 * body);
    const Eigen::Matrix3d inertia =
        axes * Vector3d(model_->body_inertia + 3 * body).asDiagonal() * axes.transpose();
    const Vector3d force =
        load.force - model_->body_mass[body] * (load.turning_up.cross(centre) +
                                                w.cross(w.cross(centre)) + 2.0 * w.cross(v));
    const Vector3d torque = -(inertia * load.turning_up) - w.cross(inertia * w);
    std::copy_n(force.data(), 3, data_->xfrc_applied + 6 * body);
    std::copy_n(torque.data(), 3, data_->xfrc_applied + 6 * body + 3);
    std::copy_n(load.acceleration.data(), 3, model_->opt.gravity);
  }

  const HandModel& hand_;
  const geometric::RobotModel& robot_;
  const planning::Pregrasp& grasp_;
  Pose X_WP_;
  const HoldConditions& conditions_;
  planning::Configuration begin_;  ///< Posture that the squeeze begins with.
  std::stop_token stop_;
  const planning::HoldWatcher& watch_;
  int load_ = 0;
  double elapsed_ = 0.0;                ///< s of the last load.
  std::vector<double> largest_forces_;  ///< N, by body; empty: not noted.
  double largest_torque_ = 0.0;         ///< Share of its limit.
  int strongest_ = -1;                  ///< Link of the joint with that torque.
  ModelPointer model_;
  DataPointer data_;
  DataPointer squeezed_;
  Pose grasp_pose_;
  Pose squeezed_pose_;
};

}  // namespace

MujocoHoldTest::MujocoHoldTest(const planning::PlanningProblem& problem, std::string_view object,
                               int palm)
    : robot_(problem.scene->robots.front().model),
      palm_(palm),
      X_WB_(problem.scene->robots.front().X_WB),
      X_WO_(planning::need_object(*problem.scene, object).X_PO),
      hand_(hand_model(problem.model(), palm, planning::need_object(*problem.scene, object))) {}

HoldResult MujocoHoldTest::test(const planning::Pregrasp& grasp, const HoldConditions& conditions,
                                const std::stop_token& stop,
                                const planning::HoldWatcher& watch) const {
  std::vector<Pose> X_BL(static_cast<std::size_t>(robot_->link_count()));
  robot_->forward_kinematics(grasp.closed, X_BL);
  const Pose& X_BP = X_BL[static_cast<std::size_t>(palm_)];
  const Eigen::Matrix3d R_PW = (X_WB_ * X_BP).linear().transpose();
  Pose X_WO = X_WO_;
  X_WO.pretranslate(conditions.misplacement);
  Simulation simulation(hand_, *robot_, grasp, X_WB_ * X_BP, X_WO, conditions, stop, watch);
  HoldResult result;
  result.squeeze = simulation.squeeze();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d force_P = sign * conditions.force * R_PW.col(axis);
      const HoldSlip slip = simulation.load(kDisturbanceTime, kSettled, [&](double) {
        return Load{force_P, Vector3d::Zero()};
      });
      if (stop.stop_requested()) {
        return result;
      }
      result.directions.push_back(slip);
    }
  }
  // In the frame of the palm, which is raised, everything is pulled down the more.
  const HoldSlip lift =
      simulation.load(kLiftTime + kLiftHoldTime, kLiftTime + kSettled, [&](double time) {
        return Load{Vector3d::Zero(), -(kGravity + lift_acceleration(time)) * R_PW.col(2)};
      });
  if (!stop.stop_requested()) {
    result.lift = lift;
  }
  return result;
}

planning::CarryResult MujocoHoldTest::carry(const planning::Pregrasp& grasp,
                                            const planning::PalmMotion& motion,
                                            const HoldConditions& conditions,
                                            const std::stop_token& stop,
                                            const planning::HoldWatcher& watch) const {
  constexpr double kLongestStep = 0.005;  // s, of the simulation
  if (motion.X_WP.empty() || !(motion.period > 0.0 && motion.period <= kLongestStep)) {
    throw std::invalid_argument("a motion needs poses, and a period of at most 5 ms");
  }
  return Simulation(hand_, *robot_, grasp, motion.X_WP.front(), X_WO_, conditions, stop, watch)
      .carry(motion);
}

std::vector<std::string> MujocoHoldTest::assumptions() const {
  std::vector<std::string> sentences = hand_.warnings;
  sentences.insert(
      sentences.end(),
      {"Fingers pass through each other, and nothing but the hand touches the object.",
       "Each link weighs 50 g; gravity does not bend the fingers.",
       "Joint torques and stiffness are those of the test's conditions, the same for all joints."});
  return sentences;
}

}  // namespace handway::simulate_mujoco

HANDWAY_PLUGIN({.name = "simulate_mujoco",
                .version = HANDWAY_VERSION,
                .make_hold_test = [](const handway::planning::PlanningProblem& problem,
                                     std::string_view object,
                                     int palm) -> std::unique_ptr<handway::planning::HoldTest> {
                  return std::make_unique<handway::simulate_mujoco::MujocoHoldTest>(problem, object,
                                                                                    palm);
                }});
