#include "query/query_hits.h"

#include "base/digest.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint64_t k_hit_seed = 0x686974u, k_hits_seed = 0x68697473u;

template <class Int, int frac>
uint64_t bits_of(Fixed<Int, frac> value) {
  return static_cast<uint64_t>(static_cast<int64_t>(value.raw));
}
[[maybe_unused]] uint64_t bits_of(float value) { return __builtin_bit_cast(uint32_t, value); }
[[maybe_unused]] uint64_t bits_of(double value) { return __builtin_bit_cast(uint64_t, value); }

uint64_t digest_of(const QueryHit& hit) {
  uint64_t running = digest_step(k_hit_seed, uint64_t{hit.body.generation} << 32 | hit.body.slot);
  running = digest_step(running, hit.undecided ? 1 : 0);
  running = digest_step(running, bits_of(hit.fraction));
  running = digest_step(running, bits_of(hit.distance));
  const Coord place[] = {hit.point.x, hit.point.y, hit.point.z};
  const Unit normal[] = {hit.normal.x, hit.normal.y, hit.normal.z};
  for (const Coord x : place) running = digest_step(running, bits_of(x));
  for (const Unit x : normal) running = digest_step(running, bits_of(x));
  if (hit.triangle != UINT32_MAX) running = digest_step(running, uint64_t{hit.material} << 32 | hit.triangle);
  return digest_finish(running);
}

}  // namespace

bool HitOrder::operator()(const QueryHit& a, const QueryHit& b) const {
  if (!(a.fraction == b.fraction)) return a.fraction < b.fraction;
  if (!(a.distance == b.distance)) return a.distance < b.distance;
  if (a.undecided != b.undecided) return b.undecided;
  if (a.body.slot != b.body.slot) return a.body.slot < b.body.slot;
  return a.triangle < b.triangle;
}

HitCollector::HitCollector(bool all, QueryHits out, Fraction end, Real distance_max)
    : all_(all), end_(end), distance_max_(distance_max), kept_{{out.data, out.capacity}, {}} {}

void HitCollector::add(const QueryHit& hit) {
  if (all_) {
    kept_.add(hit);
    digest_ += digest_of(hit);
    ++count_;
    undecided_ += hit.undecided ? 1 : 0;
    return;
  }
  if (count_ != 0 && !HitOrder{}(hit, first_)) return;
  first_ = hit;
  count_ = 1;
  undecided_ = hit.undecided ? 1 : 0;
  // An undecided hit does not narrow the limits, because decided hits that are equally near would come before it.
  if (hit.undecided) return;
  end_ = hit.fraction;
  distance_max_ = hit.distance;
  if (hit.fraction.raw == 0 && hit.distance == Real(0.0)) first_slot_ = hit.body.slot - 1;
}

void HitCollector::finish(QueryReport& report) {
  if (!all_ && count_ != 0) {
    kept_.add(first_);
    digest_ = digest_of(first_);
  }
  heap_sort(kept_.storage.first(kept_.count), HitOrder{});
  report = {kept_.count, kept_.dropped, undecided_,
            digest_finish(digest_step(digest_step(k_hits_seed, count_), digest_))};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
