// Runs every file of the corpus through every target, without libFuzzer: replay_corpus FOLDER
// Writes stored states of the program as it is for the fuzzer to begin with: replay_corpus --seeds FOLDER
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream input(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(input), {}};
}

// True without a fault.
bool replay(const std::string& file, const std::string& bytes) {
  for (const auto& target : ashlar::fuzz::targets) {
    const auto fail = [&](const char* what) {
      std::fprintf(stderr, "%s: %s: %s\n", file.c_str(), std::string(target.name).c_str(), what);
      return false;
    };
    try {
      (void)target.run(bytes);
    } catch (const ashlar::fuzz::BrokenPromise& broken) {
      return fail(broken.what);
    } catch (const std::exception& error) {
      return fail(error.what());
    }
  }
  return true;
}

// Every target with a stable format has seeds that its reader accepts; otherwise fuzzing would begin far from valid input.
bool has_good_seeds(const fs::path& folder) {
  bool good = true;
  for (const auto& target : ashlar::fuzz::targets) {
    if (!target.lasting) continue;
    const std::vector<fs::path> files = files_of(folder / target.name);
    if (std::any_of(files.begin(), files.end(),
                    [&](const fs::path& file) { return target.run(bytes_of(file)); }))
      continue;
    std::fprintf(stderr, "%s: no file is taken by its reader\n", std::string(target.name).c_str());
    good = false;
  }
  return good;
}

bool takes_stored_states() {
  bool good = true;
  for (const std::string& state : ashlar::fuzz::stored_states()) {
    good = replay("stored state", state) && good;
    if (ashlar::fuzz::checkpoint(state)) continue;
    std::fprintf(stderr, "checkpoint: a stored state is not taken\n");
    good = false;
  }
  return good;
}

int write_seeds(const fs::path& folder) {
  int number = 0;
  for (const std::string& state : ashlar::fuzz::stored_states()) {
    std::ofstream file(folder / ("state_" + std::to_string(++number)), std::ios::binary);
    if (!(file << state).flush()) return 1;
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 3 && std::string(arguments[1]) == "--seeds") return write_seeds(arguments[2]);
  if (count != 2) {
    std::fprintf(stderr, "usage: replay_corpus [--seeds] FOLDER\n");
    return 2;
  }
  const std::vector<fs::path> files = files_of(arguments[1]);
  bool good = true;
  for (const fs::path& file : files) good = replay(file.string(), bytes_of(file)) && good;
  good = good && has_good_seeds(arguments[1]) && takes_stored_states();
  std::printf("%zu files, %zu targets: %s\n", files.size(), ashlar::fuzz::targets.size(),
              good ? "good" : "failed");
  return good ? 0 : 1;
}
