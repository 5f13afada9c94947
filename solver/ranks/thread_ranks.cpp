#include "solver/ranks/thread_ranks.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "geometry/index.hpp"
#include "solver/stopwatch.hpp"
#include "solver/system/processor_watch.hpp"

namespace ashlar {
namespace {

/// Place where threads meet and leave messages.
class MeetingPlace {
 public:
  explicit MeetingPlace(int count)
      : count_(count), messages_(at(count), std::vector<Bytes>(at(count))), given_(at(count)) {}

  /// Waits for all threads. @throws OtherRankFailed if one has failed
  void meet() {
    std::unique_lock lock(mutex_);
    if (failed_) throw OtherRankFailed();
    if (++arrived_ == count_) {
      arrived_ = 0;
      ++meetings_;
      all_here_.notify_all();
      return;
    }
    const int meeting = meetings_;
    all_here_.wait(lock, [&] { return failed_ || meetings_ != meeting; });
    if (meetings_ == meeting) throw OtherRankFailed();
  }
  void fail() {
    const std::lock_guard lock(mutex_);
    failed_ = true;
    all_here_.notify_all();
  }

  [[nodiscard]] int count() const { return count_; }
  /// To be written before and read after a meeting.
  [[nodiscard]] Bytes& message(int sender, int receiver) { return messages_[at(sender)][at(receiver)]; }
  [[nodiscard]] std::vector<Bytes>& given() { return given_; }

 private:
  int count_;
  std::mutex mutex_;
  std::condition_variable all_here_;
  int arrived_ = 0;
  int meetings_ = 0;
  bool failed_ = false;
  std::vector<std::vector<Bytes>> messages_;  ///< by sender and receiver
  std::vector<Bytes> given_;                  ///< by rank
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(MeetingPlace& place, int own) : place_(place), own_(own) {}

  [[nodiscard]] int count() const override { return place_.count(); }
  [[nodiscard]] int own() const override { return own_; }

  [[nodiscard]] std::vector<Bytes> gather(const Bytes& given) override {
    const Stopwatch watch(traffic_.seconds);
    const ProcessorWatch processor(traffic_.processor);
    note(count() - 1, given.size() * at(count() - 1));
    place_.given()[at(own_)] = given;
    place_.meet();
    std::vector<Bytes> result = place_.given();
    place_.meet();
    ++traffic_.calls;
    return result;
  }

  [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> messages) override {
    const Stopwatch watch(traffic_.seconds);
    const ProcessorWatch processor(traffic_.processor);
    for (int rank = 0; rank < count(); ++rank) {
      if (rank != own_ && !messages[at(rank)].empty()) note(1, messages[at(rank)].size());
      place_.message(own_, rank) = std::move(messages[at(rank)]);
    }
    place_.meet();
    std::vector<Bytes> received;
    received.reserve(at(count()));
    for (int rank = 0; rank < count(); ++rank) received.push_back(std::move(place_.message(rank, own_)));
    place_.meet();
    ++traffic_.calls;
    return received;
  }

  [[nodiscard]] RankTraffic traffic() const override { return traffic_; }

 private:
  void note(int messages, std::size_t bytes) {
    traffic_.messages += static_cast<std::uint64_t>(messages);
    traffic_.bytes += bytes;
  }

  MeetingPlace& place_;
  int own_;
  RankTraffic traffic_;
};

}  // namespace

void run_on_threads(int count, const std::function<void(Ranks&)>& program) {
  MeetingPlace place(count);
  std::vector<std::exception_ptr> errors(at(count));
  std::vector<std::exception_ptr> heard(at(count));
  std::vector<std::thread> threads;
  threads.reserve(at(count));
  for (int own = 0; own < count; ++own) {
    threads.emplace_back([&, own] {
      ThreadRanks ranks(place, own);
      try {
        program(ranks);
        return;
      } catch (const OtherRankFailed&) {
        heard[at(own)] = std::current_exception();
      } catch (...) {
        errors[at(own)] = std::current_exception();
      }
      place.fail();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  for (const std::exception_ptr& error : heard)
    if (error) std::rethrow_exception(error);
}

}  // namespace ashlar
