#include "model/jobs/background.h"

#include "patience.h"
#include "window_test.h"

#include <QSignalSpy>

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <future>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <stop_token>
#include <utility>
#include <vector>

namespace handway::gui {
namespace {

using test::kPatienceMs;

void wait_for(const std::stop_token& stop) {
  std::promise<void> stopped;
  const std::stop_callback on_stop(stop, [&stopped] { stopped.set_value(); });
  stopped.get_future().wait();
}

template <typename Condition>
bool waits_until(Condition condition) {
  return QTest::qWaitFor(condition, kPatienceMs);
}

// A job that runs until a stop is requested.
class LongJob {
 public:
  void run_on(LatestJob& ticket) {
    ticket.run([this](const std::stop_token& stop) -> LatestJob::Answer {
      begun_.set_value();
      wait_for(stop);
      ended_ = true;
      return [this] { answered_ = true; };
    });
    begun_.get_future().wait();
  }
  [[nodiscard]] bool ended() const { return ended_; }
  [[nodiscard]] bool answered() const { return answered_; }

 private:
  std::promise<void> begun_;
  std::atomic<bool> ended_ = false;
  bool answered_ = false;
};

// Returns a job that adds `number` to the answers.
LatestJob::Job answering(std::vector<int>& answers, int number) {
  return [&answers, number](const std::stop_token&) {
    return [&answers, number] { answers.push_back(number); };
  };
}

std::ptrdiff_t threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST(LatestJob, HasNoThreadWhileIdle) {
  const std::ptrdiff_t before = threads();
  const std::vector<LatestJob> tickets(100);
  EXPECT_LE(threads(), before);
}

// Without a job that runs, nobody waits for the thread.
TEST(LatestJob, MayBeDestroyedBeforeItsThreadBegins) {
  for (int round = 0; round < 1000; ++round) {
    LatestJob ticket;
    ticket.run([](const std::stop_token&) -> LatestJob::Answer { return {}; });
  }
}

TEST(LatestJob, RunsWhileManyLongJobsRun) {
  HANDWAY_NEED_DISPLAY();
  std::vector<std::pair<LongJob, LatestJob>> long_jobs(100);
  for (auto& [job, ticket] : long_jobs) {
    job.run_on(ticket);
  }
  LatestJob query;
  std::vector<int> answers;
  query.run(answering(answers, 1));
  EXPECT_TRUE(waits_until([&] { return !answers.empty(); }));
  EXPECT_FALSE(long_jobs.front().first.ended());
  EXPECT_FALSE(long_jobs.back().first.ended());
}

TEST(LatestJob, IsStoppedAndAwaitedByItsDestructor) {
  LongJob job;
  std::atomic<bool> began = false;
  {
    LatestJob ticket;
    job.run_on(ticket);
    ticket.run_next([&began](const std::stop_token&) -> LatestJob::Answer {
      began = true;
      return {};
    });
  }
  EXPECT_TRUE(job.ended());
  EXPECT_FALSE(began);
}

TEST(LatestJob, IsStoppedByTheNextAndByCancelling) {
  HANDWAY_NEED_DISPLAY();
  LatestJob ticket;
  const QSignalSpy ended(&ticket, &LatestJob::ended);
  LongJob first;
  LongJob second;
  first.run_on(ticket);
  second.run_on(ticket);  // begins once the first has ended
  EXPECT_TRUE(first.ended());
  EXPECT_EQ(ended.count(), 0);
  ticket.cancel();
  EXPECT_EQ(ended.count(), 1);
  EXPECT_FALSE(ticket.is_busy());
  EXPECT_TRUE(waits_until([&] { return second.ended(); }));
  std::vector<int> answers;
  ticket.run(answering(answers, 1));
  EXPECT_TRUE(waits_until([&] { return !ticket.is_busy(); }));
  EXPECT_EQ(answers, std::vector{1});
  EXPECT_FALSE(first.answered());
  EXPECT_FALSE(second.answered());
}

TEST(LatestJob, AnswersTheRunningAndTheLatestWaitingJob) {
  HANDWAY_NEED_DISPLAY();
  LatestJob ticket;
  std::vector<int> answers;
  std::promise<void> begun;
  std::promise<void> go_on;
  ticket.run_next([&](const std::stop_token&) {
    begun.set_value();
    go_on.get_future().wait();
    return [&answers] { answers.push_back(0); };
  });
  begun.get_future().wait();
  for (const int number : {1, 2, 3}) {
    ticket.run_next(answering(answers, number));
  }
  go_on.set_value();
  EXPECT_TRUE(ticket.is_busy());
  EXPECT_TRUE(waits_until([&] { return !ticket.is_busy(); }));
  EXPECT_EQ(answers, (std::vector{0, 3}));
}

TEST(LatestJob, ReportsWhatAJobThrows) {
  HANDWAY_NEED_DISPLAY();
  LatestJob ticket;
  const QSignalSpy failed(&ticket, &LatestJob::failed);
  const QSignalSpy ended(&ticket, &LatestJob::ended);
  ticket.run([](const std::stop_token&) -> LatestJob::Answer { throw std::runtime_error("no"); });
  EXPECT_TRUE(waits_until([&] { return !ticket.is_busy(); }));
  ASSERT_EQ(failed.count(), 1);
  EXPECT_EQ(failed.front().front().toString(), QStringLiteral("no"));
  EXPECT_EQ(ended.count(), 1);
}

TEST(BackgroundJobs, RunTogetherAndAreAwaited) {
  std::atomic<int> ended = 0;
  std::vector<std::promise<void>> begun(2);
  std::promise<void> end;
  const std::shared_future<void> at_end = end.get_future().share();
  {
    BackgroundJobs jobs;
    for (std::promise<void>& job : begun) {
      jobs.run([&ended, &job, at_end] {
        job.set_value();
        at_end.wait();
        ++ended;
      });
    }
    for (std::promise<void>& job : begun) {
      job.get_future().wait();
    }
    end.set_value();
  }
  EXPECT_EQ(ended, 2);
}

}  // namespace
}  // namespace handway::gui
