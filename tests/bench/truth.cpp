#include "tests/bench/truth.h"

#include <string.h>

#include <filesystem>
#include <fstream>

#include "tests/common/oracle/convex_toi.h"
#include "tests/common/queries/gap.h"
#include "tests/common/queries/solids.h"

namespace detent_bench {

using detent_queries::Query;

namespace {

constexpr uint64_t k_version = 1 ^ DETENT_BENCH_ORACLE;  ///< of the file, and a hash of the oracle's sources
constexpr size_t k_numbers = 6;                          ///< of a truth, in the file

struct Header {
  uint64_t version = k_version;
  uint64_t count = 0;
  uint64_t digest = 0;  ///< of the queries
};

class Digest {
 public:
  void add(double value) {
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 64; i += 8) state_ = (state_ ^ (bits >> i & 0xff)) * 0x100000001b3u;  // FNV-1a
  }
  template <class Numbers>
  void add_all(const Numbers& numbers) {
    for (const double number : numbers) add(number);
  }
  void add(const detent_queries::Solid& solid) {
    for (const double number : {static_cast<double>(solid.kind), solid.radius, solid.half_length, solid.rounding})
      add(number);
    add_all(solid.half_extents);
    for (const detent_queries::Triple& point : solid.points) add_all(point);
  }
  void add(const detent_queries::Path& path) {
    add_all(path.position);
    add_all(path.rotation);
    add_all(path.displacement);
    add_all(path.rotation_vector);
  }
  uint64_t value() const { return state_; }

 private:
  uint64_t state_ = 0xcbf29ce484222325u;
};

uint64_t digest_of(const std::vector<Query>& queries, bool moving) {
  Digest digest;
  digest.add(moving ? 1.0 : 0.0);
  for (const Query& query : queries) {
    digest.add(query.a);
    digest.add(query.b);
    digest.add(query.path_a);
    digest.add(query.path_b);
  }
  return digest.value();
}

bool load(const std::string& path, const Header& expected, std::vector<Truth>& truths) {
  std::ifstream file(path, std::ios::binary);
  Header header;
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header) || memcmp(&header, &expected, sizeof header) != 0)
    return false;
  std::vector<double> numbers(k_numbers * expected.count);
  const auto bytes = static_cast<std::streamsize>(numbers.size() * sizeof(double));
  if (!file.read(reinterpret_cast<char*>(numbers.data()), bytes)) return false;
  for (size_t i = 0; i < expected.count; ++i) {
    const double* n = &numbers[k_numbers * i];
    truths.push_back({n[0], n[1], n[2] != 0, n[3], n[4], n[5] != 0});
  }
  return true;
}

void save(const std::string& path, const Header& header, const std::vector<Truth>& truths) {
  std::vector<double> numbers;
  for (const Truth& truth : truths) {
    for (const double number :
         {truth.size, truth.start_gap, truth.hit ? 1.0 : 0.0, truth.time, truth.gap_min, truth.certain ? 1.0 : 0.0})
      numbers.push_back(number);
  }
  // Under another name first: a run that is stopped leaves no half of a file behind.
  {
    std::ofstream file(path + ".new", std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    file.write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(double)));
  }
  std::error_code ignored;
  std::filesystem::rename(path + ".new", path, ignored);
}

Truth truth_of(const Query& query, bool moving) {
  Truth truth;
  truth.size = detent_queries::size_of(query);
  truth.start_gap = detent_queries::gap_at(query, 0);
  if (!moving) return truth;
  const detent_oracle::Verdict verdict = detent_oracle::judge(query);
  truth.hit = verdict.hit;
  truth.time = static_cast<double>(verdict.time);
  truth.gap_min = static_cast<double>(verdict.gap_min);
  truth.certain = verdict.certain && verdict.complete;
  return truth;
}

}  // namespace

std::vector<Truth> truth_of(const std::vector<Query>& queries, bool moving, const std::string& cache,
                            const std::string& key, const Progress& progress) {
  Header header;
  header.count = queries.size();
  header.digest = digest_of(queries, moving);
  const std::string path = cache + "/" + key + ".truth";
  std::vector<Truth> truths;
  if (!cache.empty() && load(path, header, truths)) return truths;
  truths.clear();
  for (const Query& query : queries) {
    truths.push_back(truth_of(query, moving));
    progress(truths.size(), queries.size());
  }
  if (!cache.empty()) save(path, header, truths);
  return truths;
}

}  // namespace detent_bench
