#include "features/robots/pair_table.h"

#include <QHeaderView>
#include <QSignalBlocker>

#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace handway::gui {
namespace {

using geometric::AllowedCollisions;
using geometric::AllowedReason;
using geometric::SampledPair;

enum Column { kLinks, kWhy, kShare, kColumnCount };
constexpr int kKindRole = Qt::UserRole;
constexpr int kFirstRole = Qt::UserRole + 1;  // and the second link after it

// In the order of kinds().
enum Kind { kAll, kChecked, kAdjacent, kAlways, kDefault, kNever, kByHand, kKindCount };

Kind kind_of(std::optional<AllowedReason> reason) {
  if (!reason) {
    return kChecked;
  }
  switch (*reason) {
    case AllowedReason::kAdjacent:
      return kAdjacent;
    case AllowedReason::kAlways:
      return kAlways;
    case AllowedReason::kDefault:
      return kDefault;
    case AllowedReason::kNever:
      return kNever;
    case AllowedReason::kUser:
      return kByHand;
  }
  return kByHand;
}

QString words_for(Kind kind) {
  static const std::array<QString, kKindCount> kWords = {
      PairTable::tr("All pairs"),          PairTable::tr("Checked"),
      PairTable::tr("Adjacent"),           PairTable::tr("Always touch"),
      PairTable::tr("Overlap by default"), PairTable::tr("Never touch"),
      PairTable::tr("Allowed by hand")};
  return kWords.at(static_cast<std::size_t>(kind));
}

AllowedCollisions::Pair pair_of(const QTreeWidgetItem& row) {
  return {row.data(kLinks, kFirstRole).toString().toStdString(),
          row.data(kLinks, kFirstRole + 1).toString().toStdString()};
}

Kind kind_of(const QTreeWidgetItem& row) {
  return static_cast<Kind>(row.data(kLinks, kKindRole).toInt());
}

}  // namespace

PairTable::PairTable(QWidget* parent) : QTreeWidget(parent) {
  setObjectName(QStringLiteral("setup_pairs"));
  setAccessibleName(tr("Pairs of links"));
  setColumnCount(kColumnCount);
  setHeaderLabels({tr("May touch"), tr("Why"), tr("Postures, %")});
  headerItem()->setToolTip(kShare, tr("Share of the random postures in which the two collide"));
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(QHeaderView::ResizeToContents);
  header()->setSectionResizeMode(kLinks, QHeaderView::Stretch);
  setRootIsDecorated(false);
  setUniformRowHeights(true);
  setSortingEnabled(true);
  sortByColumn(kShare, Qt::DescendingOrder);
  connect(this, &QTreeWidget::itemChanged, this, [this](const QTreeWidgetItem* row) {
    emit decided(pair_of(*row), row->checkState(kLinks) == Qt::Checked);
  });
  connect(this, &QTreeWidget::currentItemChanged, this, [this](const QTreeWidgetItem* row) {
    if (row) {
      emit looked_at(pair_of(*row));
    }
  });
}

void PairTable::show_pairs(const geometric::SelfCollisionSamples& sampled,
                           const AllowedCollisions& allowed) {
  const QSignalBlocker quiet(this);
  clear();
  setSortingEnabled(false);
  std::map<AllowedCollisions::Pair, double> shares;
  for (const SampledPair& pair : sampled.pairs) {
    shares[std::minmax(pair.a, pair.b)] = 100.0 * pair.collisions / sampled.samples;
  }
  for (const auto& [pair, share] : shares) {
    add(pair, allowed.reason(pair.first, pair.second), share);
  }
  for (const auto& [pair, reason] : allowed.entries()) {
    if (!shares.contains(pair)) {
      add(pair, reason, 100.0);
    }
  }
  setSortingEnabled(true);
}

void PairTable::add(const AllowedCollisions::Pair& pair, std::optional<AllowedReason> reason,
                    double share) {
  const QString a = QString::fromStdString(pair.first);
  const QString b = QString::fromStdString(pair.second);
  auto* row = new QTreeWidgetItem(this);
  const Kind kind = kind_of(reason);
  row->setText(kLinks, tr("%1 and %2").arg(a, b));
  row->setToolTip(kLinks, row->text(kLinks));
  row->setCheckState(kLinks, reason ? Qt::Checked : Qt::Unchecked);
  row->setData(kLinks, kKindRole, kind);
  row->setData(kLinks, kFirstRole, a);
  row->setData(kLinks, kFirstRole + 1, b);
  row->setText(kWhy, words_for(kind));
  row->setData(kShare, Qt::DisplayRole,
               kind == kAdjacent ? QVariant() : QVariant(std::round(10.0 * share) / 10.0));
}

QStringList PairTable::kinds() const {
  std::array<int, kKindCount> counts{};
  for (int i = 0; i < topLevelItemCount(); ++i) {
    ++counts.at(kAll);
    ++counts.at(static_cast<std::size_t>(kind_of(*topLevelItem(i))));
  }
  QStringList kinds;
  for (int kind = 0; kind < kKindCount; ++kind) {
    kinds << tr("%1 (%2)").arg(words_for(static_cast<Kind>(kind))).arg(counts.at(kind));
  }
  return kinds;
}

void PairTable::show_kind(int kind) {
  for (int i = 0; i < topLevelItemCount(); ++i) {
    topLevelItem(i)->setHidden(kind != kAll && kind_of(*topLevelItem(i)) != kind);
  }
}

}  // namespace handway::gui
