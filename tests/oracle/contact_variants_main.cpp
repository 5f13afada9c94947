// Runs any number of variants of degenerate pairs through the classifier and counts changed answers.
//
//   contact_variants 60000000 1      60 million variants from seed 1; about a minute for a million
//
// Exit status: 0 no answer changed, 1 some did (the first few are printed), 2 wrong usage.
#include <charconv>
#include <iostream>
#include <map>
#include <string_view>

#include "oracle/contact_comparison.hpp"
#include "oracle/degenerate_pairs.hpp"

namespace {

using namespace ashlar;
using namespace ashlar::oracle;

constexpr int kVariantsPerPair = 20;
constexpr long kMostReported = 10;
constexpr long kProgressEvery = 1000000;

bool read_number(std::string_view text, std::uint64_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

void print(const DegeneratePair& pair, const Variant& variant, const Differences& differences) {
  std::cout << pair.family << "\n  pair    " << to_json(pair.p, pair.q) << "\n  variant "
            << to_json(variant.p, variant.q) << "\n";
  for (const std::string& difference : differences) std::cout << "  " << difference << "\n";
}

long run(std::uint64_t count, std::uint64_t seed) {
  DegeneratePairs pairs(seed);
  Random random(~seed);
  std::map<std::string, std::uint64_t> types;
  long changed = 0;
  for (std::uint64_t done = 0; done < count;) {
    const DegeneratePair pair = pairs.next();
    const Variants variants(pair.p, pair.q);
    const ConvexContact original = classify(to_convex_shape(pair.p), to_convex_shape(pair.q));
    for (int j = 0; j < kVariantsPerPair && done < count; ++j, ++done) {
      const Variant variant = variants.random(random);
      const ConvexContact answer = classify(to_convex_shape(variant.p), to_convex_shape(variant.q));
      ++types[std::string(to_string(answer.type()))];
      const Differences differences =
          compare_with_variant(original, answer, variant, pair.p.triangles.size() == 1);
      if (!differences.empty() && ++changed <= kMostReported) print(pair, variant, differences);
      if ((done + 1) % kProgressEvery == 0) {
        std::cerr << done + 1 << " variants, " << changed << " changed answers\n";
      }
    }
  }
  for (const auto& [type, number] : types) {
    std::cout << type << ": " << 100.0 * static_cast<double>(number) / static_cast<double>(count) << " %\n";
  }
  std::cout << count << " variants, " << changed << " changed answers\n";
  return changed;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 0;
  std::uint64_t seed = 0;
  if (argc != 3 || !read_number(argv[1], count) || !read_number(argv[2], seed)) {
    std::cerr << "usage: contact_variants COUNT SEED\n";
    return 2;
  }
  return run(count, seed) == 0 ? 0 : 1;
}
