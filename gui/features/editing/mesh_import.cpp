#include "features/editing/mesh_import.h"

#include "handway/geometric/math/units.h"
#include "widgets/forms/arrangement.h"
#include "widgets/style/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QFormLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace handway::gui {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLikelyMost = 10.0;  // m; what is larger is more likely in millimetres
constexpr QSize kPictureSize{340, 220};
constexpr std::size_t kMostDrawn = 20000;  // triangles
constexpr double kHand = 0.19;             // m, a person's

// Returns the rotation that turns the file's up axis to +z in the world; the other axes keep their
// order.
Matrix3d turned_up(int axis) {
  Matrix3d R;
  for (int i = 0; i < 3; ++i) {
    R.row(i) = Vector3d::Unit((axis + 1 + i) % 3).transpose();
  }
  return R;
}

/// An oblique view on triangles, the farthest first, with a bar as high as a hand beside them.
class Sketch {
 public:
  Sketch(const geometric::TriangleMesh& mesh, const QSize& size) {
    const Matrix3d R = (Eigen::AngleAxisd(-geometric::radians(65.0), Vector3d::UnitX()) *
                        Eigen::AngleAxisd(geometric::radians(-35.0), Vector3d::UnitZ()))
                           .toRotationMatrix();
    for (const Vector3d& v : mesh.vertices) {
      seen_.emplace_back(R * v);
    }
    const geometric::Aabb box = geometric::bounding_box({seen_, mesh.triangles});
    constexpr double kFilled = 0.86;
    per_metre_ = kFilled * std::min(size.width() / std::max(box.size().x() + 0.3 * kHand, kHand),
                                    size.height() / std::max(box.size().y(), kHand));
    middle_ = box.centre();
    in_picture_ = QPointF(0.5 * size.width(), 0.5 * size.height());
    beside_ = {box.lower.x() - 0.15 * kHand, box.lower.y(), 0.0};
  }

  void paint(QPainter& painter, const geometric::TriangleMesh& mesh, const QColor& color) const {
    struct Face {
      double depth;
      double light;
      QPolygonF outline;
    };
    std::vector<Face> faces;
    const std::size_t every = mesh.triangles.size() / kMostDrawn + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += every) {
      const auto& [a, b, c] = mesh.triangles[i];
      const Vector3d normal = (seen_[b] - seen_[a]).cross(seen_[c] - seen_[a]);
      faces.push_back({seen_[a].z() + seen_[b].z() + seen_[c].z(),
                       std::abs(normal.normalized().dot(Vector3d(0.3, 0.5, 0.8).normalized())),
                       QPolygonF({place(seen_[a]), place(seen_[b]), place(seen_[c])})});
    }
    std::ranges::sort(faces, {}, &Face::depth);
    painter.setPen(Qt::NoPen);
    for (const Face& face : faces) {
      painter.setBrush(color.darker(static_cast<int>(230.0 - 130.0 * face.light)));
      painter.drawPolygon(face.outline);
    }
  }

  [[nodiscard]] QLineF hand() const {
    return {place(beside_), place(beside_ + kHand * Vector3d::UnitY())};
  }

 private:
  [[nodiscard]] QPointF place(const Vector3d& p) const {
    return in_picture_ + per_metre_ * QPointF(p.x() - middle_.x(), middle_.y() - p.y());
  }

  std::vector<Vector3d> seen_;
  double per_metre_ = 1.0;
  Vector3d middle_;
  Vector3d beside_;
  QPointF in_picture_;
};

QPixmap picture_of(const geometric::TriangleMesh& mesh, const QSize& size) {
  const ThemeColors colors = colors_of(current_theme());
  QPixmap picture(size);
  picture.fill(colors.surface);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  const Sketch sketch(mesh, size);
  sketch.paint(painter, mesh, QColor(150, 165, 185));
  const QLineF hand = sketch.hand();
  painter.setPen(QPen(colors.accent, 3.0, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(hand);
  return picture;
}

}  // namespace

MeshImportDialog::MeshImportDialog(const QString& file,
                                   std::shared_ptr<const geometric::TriangleMesh> mesh,
                                   bool knows_units, QWidget* parent)
    : QDialog(parent),
      mesh_(std::move(mesh)),
      unit_(named("mesh_unit", new QComboBox)),
      up_(named("mesh_up", new QComboBox)),
      size_(named("mesh_size", new QLabel)),
      picture_(named("mesh_picture", new QLabel)),
      hollow_(named("mesh_hollow", new QCheckBox(tr("Hollow")))) {
  setObjectName(QStringLiteral("mesh_import"));
  setWindowTitle(tr("Add %1").arg(QFileInfo(file).fileName()));
  unit_->setToolTip(tr("What 1 in the file is"));
  for (const auto& [name, metres] : {std::pair(tr("metres"), 1.0),
                                     {tr("centimetres"), 0.01},
                                     {tr("millimetres"), 0.001},
                                     {tr("inches"), 0.0254}}) {
    unit_->addItem(name, metres);
  }
  up_->setToolTip(tr("The file's axis that points upwards"));
  up_->addItems({QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")});
  up_->setCurrentIndex(2);
  const double largest = geometric::bounding_box(*mesh_).size().maxCoeff();
  unit_->setCurrentIndex(!knows_units && largest > kLikelyMost ? 2 : 0);
  picture_->setFixedSize(kPictureSize);
  auto* form = new QFormLayout;
  form->addRow(tr("Unit"), unit_);
  form->addRow(tr("Up axis"), up_);
  form->addRow(tr("Size"), size_);
  form->addRow(QString(), hollow_);
  hollow_->setToolTip(
      tr("A cell or a room around the robot: its walls alone count, what is inside is free"));
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
  QPushButton* add = buttons->addButton(tr("Add"), QDialogButtonBox::AcceptRole);
  add->setObjectName(QStringLiteral("mesh_add"));
  add->setProperty("role", "primary");
  add->setDefault(true);
  lay_out(*this,
          in_column({{picture_, 0, Qt::AlignHCenter},
                     note(tr("The bar at its left is as long as a hand, 19 cm.")),
                     form,
                     buttons},
                    10),
          {16, 16, 16, 12});
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(unit_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &MeshImportDialog::show_result);
  connect(up_, qOverload<int>(&QComboBox::currentIndexChanged), this,
          &MeshImportDialog::show_result);
  show_result();
}

double MeshImportDialog::scale() const { return unit_->currentData().toDouble(); }

Matrix3d MeshImportDialog::orientation() const { return turned_up(up_->currentIndex()); }

bool MeshImportDialog::is_hollow() const { return hollow_->isChecked(); }

void MeshImportDialog::show_result() {
  geometric::Pose X_WF = geometric::Pose::Identity();
  X_WF.linear() = orientation();
  const geometric::TriangleMesh seen =
      geometric::transformed(*mesh_, X_WF, Vector3d::Constant(scale()));
  const Vector3d size = geometric::bounding_box(seen).size();
  const auto mm = [](double metres) {
    return QString::number(geometric::millimetres(metres), 'f', metres < 0.1 ? 1 : 0);
  };
  size_->setText(tr("%1 × %2 × %3 mm, %4 mm high")
                     .arg(mm(size.x()), mm(size.y()), mm(size.z()), mm(size.z())));
  picture_->setPixmap(picture_of(seen, kPictureSize));
}

}  // namespace handway::gui
