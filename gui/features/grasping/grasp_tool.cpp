#include "features/grasping/grasp_tool.h"

#include "features/grasping/grasp_card.h"
#include "features/workbench.h"
#include "handway/geometric/io/replace_file.h"
#include "handway/geometric/mesh/shape.h"
#include "handway/geometric/setup/placing.h"
#include "handway/planning/grasps/given_grasps.h"
#include "handway/planning/grasps/grasp_file.h"
#include "handway/planning/queries/palm_ik.h"
#include "model/document/document.h"
#include "model/document/scene_editor.h"
#include "model/planning/planning_session.h"
#include "view3d/grasp_drawings.h"
#include "view3d/overlay.h"
#include "view3d/scene_view.h"
#include "view3d/view_gizmo.h"
#include "widgets/forms/file_dialogs.h"
#include "widgets/panels/film_bar.h"
#include "widgets/panels/log_panel.h"
#include "widgets/style/actions.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

namespace handway::gui {
namespace {

// Action on the object in a part of a hold test.
QString load_text(int load) {
  const QStringList axes{QStringLiteral("+x"), QStringLiteral("-x"), QStringLiteral("+y"),
                         QStringLiteral("-y"), QStringLiteral("+z"), QStringLiteral("-z")};
  if (load == 0) {
    return QObject::tr("Simulation: the hand squeezes.");
  }
  if (load <= axes.size()) {
    return QObject::tr("Simulation: %1 N along %2.")
        .arg(planning::HoldConditions{}.force)
        .arg(axes[load - 1]);
  }
  return QObject::tr("Simulation: raised by 10 cm, seen from the palm.");
}

planning::MeasuredGrasps grasps_from(const GraspSource& source,
                                     const planning::PlanningProblem& problem,
                                     const std::string& object, const std::stop_token& stop,
                                     const planning::PregraspProgress& progress) {
  switch (source.origin()) {
    case GraspOrigin::kFile:
      return planning::measure_grasps_of_file(source.file, problem, object, {}, stop);
    case GraspOrigin::kEdit:
      return planning::measure_given_grasps(problem, object, source.given, {}, stop);
    case GraspOrigin::kSearch:
      break;
  }
  return {planning::find_pregrasps(problem, object, {}, stop, progress), {}};
}

// Returns grasps of a search as those to measure after an edit, with their ranks for messages.
std::vector<planning::GivenGrasp> to_follow(const planning::PlanningProblem& problem,
                                            const std::string& object,
                                            const planning::Pregrasps& grasps) {
  std::vector<planning::GivenGrasp> given;
  for (const planning::Pregrasp& grasp : grasps.found) {
    const QString name = QObject::tr("Grasp %1").arg(given.size() + 1);
    given.push_back(as_given(problem, object, grasp, grasps.palm, name.toStdString()));
  }
  return given;
}

// Says which grasps are shown, and why others are not.
QString note_of(const GraspSource& source, const planning::MeasuredGrasps& measured, bool stopped) {
  if (source.origin() == GraspOrigin::kSearch) {
    return stopped ? QObject::tr("The best grasps that were found until the search was stopped.")
                   : QObject::tr("The best grasp is first; the ghost shows the selected grasp.");
  }
  QString note =
      source.origin() == GraspOrigin::kEdit
          ? QObject::tr("Measured again in the edited scene.")
          : QObject::tr("Kept in %1.").arg(QString::fromStdString(source.file.filename().string()));
  if (!measured.left_out.empty()) {
    note += QObject::tr(" %1 of %2 are not possible here: %3")
                .arg(measured.left_out.size())
                .arg(measured.left_out.size() + measured.grasps.found.size())
                .arg(QString::fromStdString(measured.left_out.front()));
  }
  return note;
}

}  // namespace

GraspOrigin GraspSource::origin() const {
  return !file.empty()    ? GraspOrigin::kFile
         : !given.empty() ? GraspOrigin::kEdit
                          : GraspOrigin::kSearch;
}

GraspTool::GraspTool(Document& document, SceneEditor& editor, PlanningSession& session,
                     SceneView& view, planning::MakeHoldTest make_hold_test, QObject* parent)
    : QObject(parent),
      document_(document),
      editor_(editor),
      session_(session),
      view_(view),
      card_(new GraspCard(&view, [this] { return to_be_seen(); })),
      make_hold_test_(make_hold_test) {
  card_->show_tests(make_hold_test_ != nullptr);
  connect(&card_->film(), &FilmBar::shown, this, &GraspTool::show_frame);
  connect(&card_->film(), &FilmBar::ended, this, &GraspTool::show_scene);
  connect(&card_->film(), &FilmBar::pictures_wanted, this,
          [this] { emit pictures_wanted(film()); });
  connect(card_, &GraspCard::film_wanted, this,
          [this](int index, bool wanted) { wanted ? begin_film(index) : card_->film().end(); });
  connect(&document_, &Document::opened, this, &GraspTool::end);
  connect(&document_, &Document::edited, this, [this](const planning::SceneState& before) {
    if (before.scene != document_.scene()) {
      follow_edit();
    }
  });
  connect(&session_, &PlanningSession::started, this, &GraspTool::end);  // to another goal
  connect(card_, &GraspCard::looked_at, this, &GraspTool::look_at);
  connect(card_, &GraspCard::chosen, this, &GraspTool::choose);
  connect(card_, &GraspCard::closed, this, &GraspTool::end);
  connect(card_, &GraspCard::stop_requested, this, [this] {
    if (ends_search_) {
      ends_search_->request_stop();
    }
  });
  connect(card_, &GraspCard::search_requested, this, [this] {
    if (const auto* object = geometric::find_object(*document_.scene(), object_)) {
      find(*object, {});
    }
  });
  connect(card_, &GraspCard::keep_requested, this, &GraspTool::keep);
  connect(&test_job_, &LatestJob::failed, card_, &GraspCard::show_untested);
  connect(&job_, &LatestJob::failed, this, [this](const QString& reason) {
    card_->show_failure(QString::fromStdString(object_), reason, source_.origin());
  });
}

void GraspTool::begin() {
  const geometric::SceneObject* object = editor_.selected_object();
  if (object && document_.problem()) {
    find(*object, {.file = object->grasps});
  }
}

void GraspTool::follow_edit() {
  const geometric::SceneObject* object = card_->isHidden() || !document_.problem()
                                             ? nullptr
                                             : geometric::find_object(*document_.scene(), object_);
  if (object == nullptr || object->attachment) {
    end();
    return;
  }
  const bool is_known = !job_.is_busy() && source_.file.empty() && !found_.empty();
  find(*object, is_known ? GraspSource{.given = found_} : source_);
}

void GraspTool::find(const geometric::SceneObject& object, const GraspSource& source) {
  emit handles_welcome(false);
  object_ = object.name;
  source_ = source;
  found_ = source.given;
  card_->film().end();
  test_job_.cancel();
  tests_.clear();
  grasps_ = {};
  card_->show_tests(make_hold_test_ != nullptr);
  card_->show_search(QString::fromStdString(object.name));
  ends_search_ = std::make_shared<std::stop_source>();
  // Without a start the motion begins where the robot is shown. Of size 0: the scene has a start.
  geometric::Configuration from;
  if (!document_.scene()->start) {
    from = document_.configuration();
  }
  job_.run([this, name = object.name, problem = document_.problem(), search = ++search_, from,
            source, ends = ends_search_](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem prepared = problem->wait(stop);
    if (!prepared) {
      return nullptr;
    }
    planning::PlanningProblem asked = *prepared;
    asked.start = from.size() > 0 ? from : asked.start;
    Eigen::Vector3d centre_O = Eigen::Vector3d::Zero();
    if (const auto* grasped = geometric::find_object(*prepared->scene, name)) {
      centre_O = planning::torque_scale(*geometric::tessellate(grasped->shape)).centre_O;
    }
    const std::stop_callback on_cancel(stop, [&ends] { ends->request_stop(); });
    const auto progress = [this, search, centre_O](const std::vector<planning::Pregrasp>& found,
                                                   double fraction) {
      QMetaObject::invokeMethod(
          this,
          [this, search, centre_O, found, fraction] {
            if (search == search_) {
              centre_O_ = centre_O;
            }
            take_progress(search, found, fraction);
          },
          Qt::QueuedConnection);
    };
    planning::MeasuredGrasps measured =
        grasps_from(source, asked, name, ends->get_token(), progress);
    auto found = source.origin() == GraspOrigin::kSearch ? to_follow(asked, name, measured.grasps)
                                                         : source.given;
    return [this, revision = problem->revision(), ends, centre_O, measured = std::move(measured),
            found = std::move(found)] {
      ++search_;  // no progress after the end
      centre_O_ = centre_O;
      palm_ = measured.grasps.palm;
      grasps_ = {measured.grasps.found, revision};
      found_ = found;
      take(measured, ends->stop_requested());
    };
  });
}

void GraspTool::take(const planning::MeasuredGrasps& measured, bool stopped) {
  const GraspOrigin origin = source_.origin();
  if (!grasps_.value.empty()) {
    card_->show_grasps(grasps_.value, note_of(source_, measured, stopped), origin);
    test();
    return;
  }
  const QString reason = origin != GraspOrigin::kSearch ? note_of(source_, measured, stopped)
                         : stopped ? tr("The search was stopped before a grasp was found.")
                                   : QString::fromStdString(measured.grasps.why_none);
  card_->show_failure(QString::fromStdString(object_), reason, origin);
}

void GraspTool::keep() {
  const std::filesystem::path& scene = document_.scene()->file;
  const std::string prefix = scene.empty() ? "" : scene.stem().string() + "_";
  const QString proposed =
      QString::fromStdString((scene.parent_path() / (prefix + object_ + "_grasps.yaml")).string());
  const QString file =
      ask_where_to_save(card_->window(), tr("Keep the grasps"), proposed, tr("Grasps (*.yaml)"));
  if (file.isEmpty() || grasps_.made_from != document_.revision()) {
    return;
  }
  try {
    const PreparedProblem::Problem problem = document_.problem()->wait({});
    geometric::replace_file(
        file.toStdString(),
        planning::grasp_file_text(*problem, object_, {}, {grasps_.value, "", palm_}));
    editor_.keep_grasps(object_, file.toStdString());
    emit kept(file);
    find(*geometric::find_object(*document_.scene(), object_), {.file = file.toStdString()});
  } catch (const std::exception& error) {
    emit failed(tr("The grasps were not kept"), QString::fromUtf8(error.what()));
  }
}

void GraspTool::take_progress(int search, std::vector<planning::Pregrasp> found, double fraction) {
  if (search != search_ || !job_.is_busy()) {
    return;
  }
  grasps_ = {std::move(found), document_.revision()};
  card_->show_progress(grasps_.value, fraction);
}

void GraspTool::look_at(int index) {
  card_->film().end();
  const planning::Pregrasp& grasp = grasps_.value[static_cast<std::size_t>(index)];
  view_.preview_ghost(false, grasp.closed.size() > 0 ? grasp.closed : grasp.q);
  const geometric::SceneObject* object = geometric::find_object(*document_.scene(), object_);
  if (object == nullptr) {
    return;
  }
  view_.set_overlay(Overlay::kGrasp, make_grasp_node(object->X_PO, centre_O_, grasp,
                                                     planning::PregraspOptions{}.contact.friction));
}

void GraspTool::test() {
  tests_.clear();
  if (make_hold_test_ == nullptr) {
    return;
  }
  test_job_.run([this, palm = palm_, make = make_hold_test_, name = object_, search = search_,
                 grasps = grasps_.value,
                 problem = document_.problem()](const std::stop_token& stop) -> LatestJob::Answer {
    const PreparedProblem::Problem prepared = problem->wait(stop);
    if (!prepared) {
      return nullptr;
    }
    const auto hold_test = make(*prepared, name, palm);
    for (const planning::Pregrasp& grasp : grasps) {
      FilmedTest filmed;
      filmed.result = hold_test->test(grasp, {}, stop, [&filmed](const planning::HoldFrame& frame) {
        filmed.frames.push_back(frame);
      });
      if (stop.stop_requested()) {
        return nullptr;
      }
      QMetaObject::invokeMethod(
          this, [this, search, filmed = std::move(filmed)] { take_test(search, filmed); },
          Qt::QueuedConnection);
    }
    return nullptr;
  });
}

void GraspTool::take_test(int search, FilmedTest test) {
  if (search != search_ || tests_.size() >= grasps_.value.size()) {
    return;
  }
  tests_.push_back(std::move(test));
  card_->show_hold(static_cast<int>(tests_.size()) - 1, tests_.back().result);
  if (tests_.size() == grasps_.value.size() && !card_->film().is_open()) {
    rank_by_tests();
  }
}

void GraspTool::rank_by_tests() {
  std::vector<std::size_t> order(tests_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(),
                           [&](std::size_t i) { return tests_[i].result.loads_held(); });
  std::vector<planning::Pregrasp> grasps;
  std::vector<FilmedTest> tests;
  for (const std::size_t i : order) {
    grasps.push_back(std::move(grasps_.value[i]));
    tests.push_back(std::move(tests_[i]));
  }
  grasps_.value = std::move(grasps);
  tests_ = std::move(tests);
  card_->show_ranked(grasps_.value);
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    card_->show_hold(static_cast<int>(i), tests_[i].result);
  }
}

void GraspTool::begin_film(int index) {
  filmed_ = static_cast<std::size_t>(index);
  if (filmed_ >= tests_.size()) {
    return;
  }
  view_.preview_ghost(false, std::nullopt);
  card_->film().begin(static_cast<int>(tests_[filmed_].frames.size()));
}

Film GraspTool::film() const {
  const std::vector<planning::HoldFrame>& frames = tests_[filmed_].frames;
  const auto moment = [item = object_item(object_)](const planning::HoldFrame& frame) {
    return FilmMoment{frame.q, {{item, frame.X_WO}}, frame.forces};
  };
  return {tr("Export pictures of the test"), QString::fromStdString(object_), document_.scene(),
          FilmBar::seconds(frames.size()), nearest_of(frames, moment)};
}

void GraspTool::show_frame(int index) {
  const planning::HoldFrame& frame = tests_[filmed_].frames[static_cast<std::size_t>(index)];
  view_.set_configuration(frame.q);
  view_.preview(object_item(object_), frame.X_WO);
  view_.set_overlay(Overlay::kGrasp, make_forces_node(frame.forces));
  card_->show_film(load_text(frame.load));
}

void GraspTool::show_scene() {
  card_->show_film({});
  const std::shared_ptr<const geometric::Scene> scene = document_.scene();
  const auto* object = scene ? geometric::find_object(*scene, object_) : nullptr;
  if (object != nullptr) {
    view_.preview(object_item(object_), object->X_PO);
  }
  if (document_.robot()) {
    view_.set_configuration(document_.configuration());
  }
  if (grasps_.made_from == document_.revision() && filmed_ < grasps_.value.size()) {
    look_at(static_cast<int>(filmed_));
  }
}

void GraspTool::end() {
  card_->film().end();
  job_.cancel();
  test_job_.cancel();
  tests_.clear();
  view_.set_overlay(Overlay::kGrasp, nullptr);
  ++search_;
  card_->hide();
  emit handles_welcome(true);
  if (!std::exchange(grasps_, {}).value.empty() && document_.robot()) {
    view_.preview_ghost(false, document_.scene()->goal);
  }
}

std::vector<QPoint> GraspTool::to_be_seen() const {
  std::vector<QPoint> places;
  const auto add = [&](const Eigen::Vector3d& point) {
    if (view_.camera().place_of(point)) {  // it is before the camera
      places.push_back(place_of(view_.camera(), view_.size(), point).toPoint());
    }
  };
  const geometric::Scene* scene = document_.scene().get();
  if (!scene || !geometric::find_object(*scene, object_)) {
    return places;
  }
  const geometric::Aabb box = geometric::bounds(*scene, document_.configuration(), {object_});
  for (int corner = 0; corner < 8; ++corner) {
    add({(corner & 1) ? box.upper.x() : box.lower.x(), (corner & 2) ? box.upper.y() : box.lower.y(),
         (corner & 4) ? box.upper.z() : box.lower.z()});
  }
  const geometric::RobotInstance& robot = *document_.robot();
  std::vector<geometric::Pose> X_BL(static_cast<std::size_t>(robot.model->link_count()));
  for (const planning::Pregrasp& grasp : grasps_.value) {
    robot.model->forward_kinematics(grasp.q, X_BL);
    for (int link = document_.palm(); link < robot.model->link_count(); ++link) {
      if (link == document_.palm() ||
          std::ranges::count(document_.joints().hand, robot.model->mimic_mapping(link).variable) >
              0) {
        add(robot.X_WB * X_BL[static_cast<std::size_t>(link)] *
            planning::middle_of(robot.model->link(link)));
      }
    }
  }
  return places;
}

void GraspTool::choose(int index) {
  if (grasps_.made_from != document_.revision()) {
    end();
    return;
  }
  const geometric::Configuration q = grasps_.value[static_cast<std::size_t>(index)].q;
  editor_.set_goal(q, document_.configuration());
  emit planning();
  session_.start();
}

void add_grasping(Workbench& workbench) {
  auto& tool = workbench.own<GraspTool>(workbench.document, workbench.editor, workbench.session,
                                        workbench.view, workbench.plugins->hold_test_maker());
  QAction* grasp = workbench.make_action(
      QStringLiteral("posture"), QObject::tr("&Grasp…"), QKeySequence(QStringLiteral("Ctrl+G")),
      QObject::tr("Find grasps of the object, choose one and plan to it"));
  workbench.add_to_menu(MainMenu::kEdit, {3, 0}, grasp);
  workbench.add_to_menu(MainMenu::kContext, {3, 0}, grasp);
  workbench.add_to_bar(MainBar::kEditing, {0, 50}, grasp);
  const auto update_enabled = [grasp, &workbench] {
    const geometric::SceneObject* object = workbench.editor.selected_object();
    allow(*grasp, !workbench.document.robot() ? QObject::tr("The scene has no robot.")
                  : !object                   ? QObject::tr("Select an object first.")
                  : object->attachment ? QObject::tr("The robot holds it already: detach it first.")
                                       : QString());
  };
  QObject::connect(grasp, &QAction::triggered, &tool, &GraspTool::begin);
  QObject::connect(&tool, &GraspTool::handles_welcome, &workbench, &Workbench::handles_welcome);
  QObject::connect(&tool, &GraspTool::kept, &workbench, [&workbench](const QString& file) {
    workbench.log.add(LogPanel::Level::kNote, QObject::tr("Kept grasps in %1").arg(file));
  });
  QObject::connect(&tool, &GraspTool::failed, &workbench, &Workbench::show_error);
  QObject::connect(&tool, &GraspTool::pictures_wanted, &workbench, &Workbench::pictures_wanted);
  QObject::connect(&tool, &GraspTool::planning, &workbench,
                   [&workbench] { workbench.show_panel("plan"); });
  QObject::connect(&workbench.document, &Document::opened, grasp, update_enabled);
  QObject::connect(&workbench.document, &Document::edited, grasp, update_enabled);
  QObject::connect(&workbench.editor, &SceneEditor::selection_changed, grasp, update_enabled);
  update_enabled();
}

}  // namespace handway::gui
