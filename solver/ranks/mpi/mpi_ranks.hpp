// Ranks that are processes of MPI.
//
// Messages between neighbours are found without a table of all pairs (Hoefler, Siebert, Lumsdaine, Scalable communication
// protocols for dynamic sparse data exchange, 2010, algorithm NBX): synchronous sends, receipt of whatever comes, and a
// barrier that one enters when one's own messages have arrived. A rank pays for its neighbours only.
// An error of MPI, such as the end of another rank, ends the program.
#pragma once

#include <memory>

#include "solver/ranks/ranks.hpp"

namespace ashlar {

/// All processes of this program, which has initialised MPI (mpi_session.hpp).
/// Its functions throw std::length_error, before anything is sent, for 2 GiB or more in one message or gather.
[[nodiscard]] std::unique_ptr<Ranks> make_mpi_ranks();

}  // namespace ashlar
