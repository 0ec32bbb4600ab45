#include "features/editing/cloud_import_dialog.h"

#include "handway/geometric/io/existing_file.h"
#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/forms/pose_form.h"
#include "widgets/forms/quantity_field.h"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QImageReader>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

namespace handway::gui {
namespace {

// Camera of many depth sensors; to be replaced by the calibrated one.
constexpr double kUsualFocal = 525.0;  // pixels
constexpr QSize kUsualImage{640, 480};

QDoubleSpinBox* pixel_field(const char* name, double value) {
  auto* field = named(name, new QDoubleSpinBox);
  field->setRange(0.0, 1e5);
  field->setDecimals(3);
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setValue(value);
  return field;
}

// A setting of imports in SI units.
geometric::Parameter import_setting(const char* key) {
  planning::CloudImport import;
  return geometric::value_of(find_parameter(in_si_units(parameters_of(import)), key));
}

QuantityField* length_field(const char* name, const char* key) {
  const geometric::Parameter setting = import_setting(key);
  auto* field =
      named(name, new QuantityField(QuantityField::Kind::kLength, setting.lower, setting.upper));
  field->setButtonSymbols(QAbstractSpinBox::NoButtons);
  field->setToolTip(QString::fromStdString(setting.help));
  field->show_quantity(std::get<double>(setting.value));
  return field;
}

QString setting_label(const char* key) { return QString::fromStdString(import_setting(key).label); }

}  // namespace

CloudImportDialog::CloudImportDialog(const std::filesystem::path& file,
                                     const std::vector<std::string>& selected, QWidget* parent)
    : QDialog(parent),
      file_(file),
      selected_(selected),
      is_image_(geometric::is_image_file(file)),
      has_own_cells_(geometric::has_extension(file, ".bt") ||
                     geometric::has_extension(file, ".ot")),
      place_(new PoseForm),
      optical_(named("cloud_optical", new QCheckBox(tr("In the camera's optical frame")))),
      cell_(length_field("cloud_cell", "cell")),
      radius_(length_field("cloud_radius", "radius")),
      robots_(named("cloud_robots", new QCheckBox(tr("Leave out the robot")))),
      margin_(length_field("cloud_margin", "margin")),
      outliers_(named("cloud_outliers", new QCheckBox(tr("Leave out single points")))),
      finds_objects_(named("cloud_find_objects", new QCheckBox(setting_label("find_objects")))),
      hidden_(named("cloud_hidden", new QCheckBox(tr("Hidden space is solid")))) {
  setObjectName(QStringLiteral("cloud_import"));
  setMinimumWidth(560);
  setWindowTitle(tr("Add %1").arg(QString::fromStdString(file.filename().string())));
  auto* form = new QFormLayout;
  add_camera(*form);
  add_place(*form);
  add_cells(*form);
  add_filters(*form);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* add = buttons->addButton(tr("Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName(QStringLiteral("cloud_add"));
  add->setProperty("role", "primary");
  add->setDefault(true);
  QLabel* words =
      note(tr("Points become the solid cells of a grid. What is between the points and "
              "behind them counts as free, unless hidden space is made solid."));
  words->setWordWrap(true);
  words->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
  lay_out(*this, in_column({words, form, buttons}, 10), {16, 16, 16, 12});
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

void CloudImportDialog::add_camera(QFormLayout& form) {
  if (!is_image_) {
    return;
  }
  const QSize read = QImageReader(QString::fromStdString(file_.string())).size();
  const QSize size = read.isValid() ? read : kUsualImage;
  const double focal = kUsualFocal * size.width() / kUsualImage.width();
  camera_ = {pixel_field("camera_fx", focal), pixel_field("camera_fy", focal),
             pixel_field("camera_cx", 0.5 * (size.width() - 1)),
             pixel_field("camera_cy", 0.5 * (size.height() - 1)), pixel_field("camera_unit", 1.0)};
  camera_[4]->setSuffix(tr(" mm"));
  camera_[4]->setRange(1e-3, 1e5);
  form.addRow(tr("Focal lengths, pixels"), in_row({camera_[0], camera_[1]}));
  form.addRow(tr("Centre, pixels"), in_row({camera_[2], camera_[3]}));
  form.addRow(tr("Depth of 1"), camera_[4]);
  camera_[0]->setToolTip(tr("fx of the camera, K[0] in ROS's CameraInfo"));
  camera_[1]->setToolTip(tr("fy of the camera, K[4] in ROS's CameraInfo"));
}

void CloudImportDialog::add_place(QFormLayout& form) {
  form.addRow(is_image_ ? tr("Camera in the world") : tr("Pose in the world"), place_);
  place_->show_pose(X_WC_);
  connect(place_, &PoseForm::pose_edited, this, [this](const geometric::Pose& X) {
    X_WC_ = X;
    place_->show_pose(X);
  });
  optical_->setChecked(is_image_);
  optical_->setVisible(!is_image_);
  optical_->setToolTip(
      tr("The points' z axis looks forwards and y down; the pose is that of the "
         "camera's body, whose x axis looks forwards"));
  form.addRow(QString(), optical_);
}

void CloudImportDialog::add_cells(QFormLayout& form) {
  if (!has_own_cells_) {
    form.addRow(setting_label("cell"), cell_);
    form.addRow(setting_label("radius"), radius_);
  }
}

void CloudImportDialog::add_filters(QFormLayout& form) {
  robots_->setChecked(true);
  outliers_->setChecked(!has_own_cells_);
  robots_->setToolTip(
      tr("Points in the links as they stand now, in what they carry, and nearer to "
         "them than the margin"));
  outliers_->setToolTip(tr("Points much farther from their neighbours than others are"));
  form.addRow(QString(), robots_);
  if (!selected_.empty()) {
    const QString words = selected_.size() == 1
                              ? tr("Leave out %1").arg(QString::fromStdString(selected_.front()))
                              : tr("Leave out %1 selected objects").arg(selected_.size());
    cut_out_ = named("cloud_cut_out", new QCheckBox(words));
    cut_out_->setChecked(true);
    form.addRow(QString(), cut_out_);
  }
  form.addRow(setting_label("margin"), margin_);
  form.addRow(QString(), outliers_);
  finds_objects_->setToolTip(QString::fromStdString(import_setting("find_objects").help));
  form.addRow(QString(), finds_objects_);
  hidden_->setToolTip(
      tr("Cells that the camera can't see, since something is in front of them, become an object "
         "of their own"));
  hidden_->setVisible(is_image_);
  form.addRow(QString(), hidden_);
}

planning::CloudImport CloudImportDialog::import() const {
  planning::CloudImport import;
  import.name = file_.stem().string();
  import.X_WC = X_WC_;
  if (optical_->isChecked()) {
    import.X_WC.linear() = X_WC_.linear() * geometric::optical_frame();
  }
  import.cells.size = cell_->quantity();
  import.cells.radius = std::min(radius_->quantity(), geometric::most_radius(import.cells.size));
  import.bodies.robots = robots_->isChecked();
  import.bodies.margin = margin_->quantity();
  if (cut_out_ != nullptr && cut_out_->isChecked()) {
    import.bodies.objects = selected_;
  }
  import.finds_objects = finds_objects_->isChecked();
  if (hidden_->isChecked()) {
    import.hidden_from = camera();
  }
  if (!outliers_->isChecked()) {
    import.outliers.reset();
  }
  return import;
}

std::optional<geometric::DepthCamera> CloudImportDialog::camera() const {
  if (!is_image_) {
    return std::nullopt;
  }
  geometric::DepthCamera camera;
  camera.focal = {camera_[0]->value(), camera_[1]->value()};
  camera.centre = {camera_[2]->value(), camera_[3]->value()};
  camera.unit = geometric::metres(camera_[4]->value());
  return camera;
}

}  // namespace handway::gui
