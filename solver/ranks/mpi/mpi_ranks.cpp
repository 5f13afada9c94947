#include "solver/ranks/mpi/mpi_ranks.hpp"

#include <mpi.h>

#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/index.hpp"
#include "solver/system/processor_watch.hpp"

namespace ashlar {
namespace {

int mpi_count(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a message between ranks of 2 GiB or more");
  return static_cast<int>(bytes);
}

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    // Not the world's own communicator: PETSc and MUMPS send messages too.
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator_);
    MPI_Comm_size(communicator_, &count_);
    MPI_Comm_rank(communicator_, &own_);
  }
  ~MpiRanks() override { MPI_Comm_free(&communicator_); }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  [[nodiscard]] int count() const override { return count_; }
  [[nodiscard]] int own() const override { return own_; }
  [[nodiscard]] std::vector<Bytes> gather(const Bytes& given) override;
  [[nodiscard]] std::vector<Bytes> exchange(std::vector<Bytes> messages) override;
  [[nodiscard]] RankTraffic traffic() const override { return traffic_; }

 private:
  /// Counts a call and its time.
  class Call {
   public:
    explicit Call(RankTraffic& traffic)
        : traffic_(traffic), begin_(MPI_Wtime()), processor_(traffic.processor) {
      ++traffic.calls;
    }
    ~Call() { traffic_.seconds += MPI_Wtime() - begin_; }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;

   private:
    RankTraffic& traffic_;
    double begin_;
    ProcessorWatch processor_;
  };

  [[nodiscard]] std::vector<MPI_Request> send(const std::vector<Bytes>& messages, int tag);
  /// Receives a message if one has arrived.
  void receive(std::vector<Bytes>& received, int tag) const;

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int count_ = 1;
  int own_ = 0;
  int tag_ = 0;
  RankTraffic traffic_;
};

std::vector<Bytes> MpiRanks::gather(const Bytes& given) {
  const Call call(traffic_);
  const int size = mpi_count(given.size());
  std::vector<int> sizes(at(count_));
  MPI_Allgather(&size, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator_);
  std::vector<int> starts(sizes.size(), 0);
  std::size_t all = 0;
  for (std::size_t rank = 0; rank < sizes.size(); ++rank) {
    starts[rank] = mpi_count(all);
    all += at(sizes[rank]);
  }
  (void)mpi_count(all);
  Bytes together(all);
  MPI_Allgatherv(given.data(), size, MPI_BYTE, together.data(), sizes.data(), starts.data(), MPI_BYTE,
                 communicator_);
  // Each part passes each rank once.
  traffic_.messages += static_cast<std::uint64_t>(count_ - 1);
  traffic_.bytes += static_cast<std::uint64_t>(count_ - 1) * given.size();
  std::vector<Bytes> result;
  for (std::size_t rank = 0; rank < sizes.size(); ++rank) {
    const auto begin = together.begin() + starts[rank];
    result.emplace_back(begin, begin + sizes[rank]);
  }
  return result;
}

std::vector<MPI_Request> MpiRanks::send(const std::vector<Bytes>& messages, int tag) {
  std::vector<MPI_Request> requests;
  for (int rank = 0; rank < count_; ++rank) {
    const Bytes& message = messages[at(rank)];
    if (rank == own_ || message.empty()) continue;
    requests.emplace_back();
    MPI_Issend(message.data(), mpi_count(message.size()), MPI_BYTE, rank, tag, communicator_,
               &requests.back());
    ++traffic_.messages;
    traffic_.bytes += message.size();
  }
  return requests;
}

void MpiRanks::receive(std::vector<Bytes>& received, int tag) const {
  int arrived = 0;
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, tag, communicator_, &arrived, &message, &status);
  if (arrived == 0) return;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Bytes& bytes = received[at(status.MPI_SOURCE)];
  bytes.resize(at(size));
  MPI_Mrecv(bytes.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
}

std::vector<Bytes> MpiRanks::exchange(std::vector<Bytes> messages) {
  if (messages.size() != at(count_)) throw std::invalid_argument("exchange: messages are not by receiver");
  for (const Bytes& message : messages) (void)mpi_count(message.size());
  const Call call(traffic_);
  std::vector<Bytes> received(at(count_));
  received[at(own_)] = std::move(messages[at(own_)]);
  // A rank may be one exchange ahead of another, never two: two tags tell their messages apart.
  tag_ = 1 - tag_;
  std::vector<MPI_Request> sends = send(messages, tag_);
  MPI_Request barrier = MPI_REQUEST_NULL;
  bool entered = false;
  int passed = 0;
  while (passed == 0) {
    receive(received, tag_);
    if (entered) {
      MPI_Test(&barrier, &passed, MPI_STATUS_IGNORE);
      continue;
    }
    int arrived = 0;
    MPI_Testall(static_cast<int>(sends.size()), sends.data(), &arrived, MPI_STATUSES_IGNORE);
    if (arrived == 0) continue;
    MPI_Ibarrier(communicator_, &barrier);
    entered = true;
  }
  return received;
}

}  // namespace

std::unique_ptr<Ranks> make_mpi_ranks() {
  return std::make_unique<MpiRanks>();
}

}  // namespace ashlar
