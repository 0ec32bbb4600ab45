#include "features/campaigns/campaigns_panel.h"

#include "window_test.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>

#include <fstream>

namespace handway::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kPatience = 60000;  // ms

class CampaignsInTheWindow : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) {
      return;
    }
    std::filesystem::copy_file(cell().post(), cell().folder() / "round_the_post.yaml");
  }

  [[nodiscard]] QString campaign(const std::string& seeds) const {
    const std::filesystem::path file = cell().folder() / "study.yaml";
    std::ofstream(file) << "campaign: 1\nname: Small study\n"
                           "problems: [{name: post, file: round_the_post.yaml}]\n"
                           "planners: [rrt-connect, pmd-rrt-connect]\nseeds: "
                        << seeds << "\n";
    return QString::fromStdString(file.string());
  }
  [[nodiscard]] QTableView& runs() const { return part<QTableView>("campaign_runs"); }
  [[nodiscard]] std::string state() const {
    return part<QLabel>("campaign_state").text().toStdString();
  }
  // Opens and waits until it is over.
  void open_in_panel(const QString& file) const {
    QSignalSpy ended(&tool<gui::CampaignsPanel>().runner(), &gui::CampaignRunner::ended);
    tool<gui::CampaignsPanel>().open(file);
    EXPECT_TRUE(ended.wait(kPatience));
  }
};

TEST_F(CampaignsInTheWindow, AreCarriedOutAndListed) {
  open_in_panel(campaign("4"));
  EXPECT_THAT(state(), AllOf(HasSubstr("Small study"), HasSubstr("8 runs, 8 with a path")));
  EXPECT_EQ(runs().model()->rowCount(), 8);
  EXPECT_EQ(part<QComboBox>("campaign_problem").currentText(), QStringLiteral("post"));
  EXPECT_TRUE(std::filesystem::exists(cell().folder() / "study" / "runs.sqlite"));
  EXPECT_TRUE(part<QPushButton>("campaign_open").isEnabled());
}

TEST_F(CampaignsInTheWindow, GoOnWhereTheyEndedAndAreReadFromTheirDatabase) {
  open_in_panel(campaign("2"));
  open_in_panel(campaign("3"));
  EXPECT_THAT(state(), HasSubstr("6 runs"));
  const auto database = (cell().folder() / "study" / "runs.sqlite").string();
  open_in_panel(QString::fromStdString(database));
  EXPECT_THAT(state(), AllOf(HasSubstr("runs.sqlite"), HasSubstr("6 runs, 6 with a path")));
  EXPECT_EQ(runs().model()->rowCount(), 6);
}

TEST_F(CampaignsInTheWindow, KeepWhatIsDoneWhenStopped) {
  QSignalSpy ended(&tool<gui::CampaignsPanel>().runner(), &gui::CampaignRunner::ended);
  QSignalSpy found(&tool<gui::CampaignsPanel>().runner(), &gui::CampaignRunner::found);
  tool<gui::CampaignsPanel>().open(campaign("100000"));
  ASSERT_TRUE(found.wait(kPatience));  // nothing was there before
  while (runs().model()->rowCount() == 0) {
    ASSERT_TRUE(found.wait(kPatience));
  }
  click("campaign_stop");
  ASSERT_TRUE(ended.wait(kPatience));
  EXPECT_THAT(state(), HasSubstr("stopped before its end"));
  EXPECT_GT(runs().model()->rowCount(), 0);
}

TEST_F(CampaignsInTheWindow, SayWhatIsWrong) {
  open_in_panel(QString::fromStdString(cell().post().string()));
  EXPECT_THAT(state(), AllOf(HasSubstr(".yaml"), HasSubstr("campaign")));
  std::ofstream(cell().folder() / "other.sqlite") << "no database";
  open_in_panel(QString::fromStdString((cell().folder() / "other.sqlite").string()));
  EXPECT_THAT(state(), HasSubstr("expected a run database"));
}

TEST_F(CampaignsInTheWindow, ShowARunThatIsClickedWithThePathItHad) {
  open_in_panel(campaign("2"));
  const QModelIndex row = runs().model()->index(1, gui::RunTable::kSeed);
  const qulonglong nodes = row.siblingAtColumn(gui::RunTable::kNodes).data().toULongLong();
  const qulonglong samples = row.siblingAtColumn(gui::RunTable::kSamples).data().toULongLong();
  QSignalSpy ended(&window().session(), &gui::PlanningSession::ended);
  emit runs().clicked(row);
  ASSERT_TRUE(ended.wait(kPatience));
  EXPECT_EQ(window().document().file().filename(), "round_the_post.yaml");
  EXPECT_EQ(window().workbench().plan_settings.planner()->name(),
            row.siblingAtColumn(gui::RunTable::kPlanner).data().toString().toStdString());
  EXPECT_EQ(window().workbench().plan_settings.request().seed, row.data().toULongLong());
  EXPECT_EQ(window().player().timeline().path().waypoints.size(), nodes);
  EXPECT_THAT(result(), HasSubstr(std::to_string(samples)));
  ASSERT_NE(window().session().roadmap(), nullptr);
  EXPECT_FALSE(window().session().roadmap()->palms.empty()) << "drawn in the view";
}

}  // namespace
}  // namespace handway::test
