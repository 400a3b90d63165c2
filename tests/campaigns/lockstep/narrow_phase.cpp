#include <detent/contact.h>
#include <detent/distance.h>
#include <detent/feature_toi.h>
#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

#include <detent/toi_methods.h>
#include "base/digest.h"
#include "distance/pair.h"
#include "distance/support.h"
#include "math/arithmetic.h"
#include "narrow_phase_pairs.h"

/// Runs the functions of the narrow phase on any target, including microcontrollers: no allocation, no C library beyond
/// string.h.
///
///   narrow_phase [QUESTION]...
///
/// Calls the function of each question, or of the named ones, for seeded pairs, and prints a digest of every bit of the
/// results: "narrow_phase <configuration> <question> <pairs> <digest>". Each question runs twice, the second time with
/// a stack that is overwritten before every call. Exit code 0 only if both digests agree;
/// 1 if not, 2 for wrong usage.

namespace {

using namespace detent;
using namespace detent_lockstep;

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

constexpr uint32_t k_pairs = 4000;
constexpr uint64_t k_seed = 0x6e6172726f77;
constexpr uint32_t k_scribbled_bytes = DETENT_SCRIBBLED_BYTES;

/// The digest so far. Each number adds its bits as one word.
class Answers {
 public:
  void add(uint64_t word) { digest_ = digest_step(digest_, word); }
  void add(Status status) { add(uint64_t{static_cast<uint32_t>(status)}); }
  template <class T>
  void number(T value) {
    add(bits_of(value));
  }
  template <class T>
  void vector(const Vec3<T>& v) {
    number(v.x);
    number(v.y);
    number(v.z);
  }
  uint64_t digest() const { return digest_finish(digest_); }

 private:
  template <class Int, int Frac>
  static uint64_t bits_of(Fixed<Int, Frac> value) {
    return static_cast<uint64_t>(int64_t{value.raw});
  }
  static uint64_t bits_of(float value) { return __builtin_bit_cast(uint32_t, value); }
  static uint64_t bits_of(double value) { return __builtin_bit_cast(uint64_t, value); }

  uint64_t digest_ = k_seed;
};

/// Calls the function, adds its result, and returns whether the pair collides. `cache`: null for none; functions
/// without a cache ignore it.
using Ask = bool (*)(const Pair& pair, DistanceCache* cache, Answers& answers);

bool ask_closest(const Pair& pair, DistanceCache* cache, Answers& answers) {
  Closest closest;
  answers.add(closest_points(pair.a, pair.motion_a.start, pair.b, pair.motion_b.start, closest, cache));
  answers.add(uint64_t{closest.overlap});
  answers.add(uint64_t{closest.capped});
  answers.number(closest.distance);
  answers.vector(closest.normal);
  answers.vector(closest.point_a);
  answers.vector(closest.point_b);
  answers.add(uint64_t{closest.iterations});
  return closest.overlap;
}

bool ask_overlap(const Pair& pair, DistanceCache* cache, Answers& answers) {
  bool meet = false;
  answers.add(overlap(pair.a, pair.motion_a.start, pair.b, pair.motion_b.start, meet, cache));
  answers.add(uint64_t{meet});
  return meet;
}

bool ask_farther(const Pair& pair, DistanceCache* cache, Answers& answers) {
  bool farther = false;
  answers.add(
      farther_than(pair.a, pair.motion_a.start, pair.b, pair.motion_b.start, pair.distance_max, farther, cache));
  answers.add(uint64_t{farther});
  return !farther;
}

bool ask_contact(const Pair& pair, DistanceCache* cache, Answers& answers) {
  ContactManifold manifold;
  answers.add(
      contact_points(pair.a, pair.motion_a.start, pair.b, pair.motion_b.start, pair.distance_max, manifold, cache));
  answers.vector(manifold.normal);
  answers.add(uint64_t{manifold.count});
  answers.add(uint64_t{manifold.capped});
  for (uint32_t i = 0; i < manifold.count; ++i) {
    const ManifoldPoint& point = manifold.point[i];
    answers.vector(point.from_a);
    answers.vector(point.from_b);
    answers.number(point.separation);
    answers.add(uint64_t{point.feature});
  }
  return manifold.count > 0;
}

template <ToiMethod method>
bool ask_toi(const Pair& pair, DistanceCache*, Answers& answers) {
  TimeOfImpact impact;
  answers.add(time_of_impact_by(method, pair.a, pair.motion_a, pair.b, pair.motion_b, impact));
  answers.add(uint64_t{static_cast<uint32_t>(impact.outcome)});
  answers.number(impact.time);
  answers.vector(impact.normal);
  answers.vector(impact.point);
  answers.add(uint64_t{impact.gjk_calls});
  answers.add(uint64_t{impact.passes});
  return impact.outcome == ToiOutcome::hit;
}

bool add_hit(const CastHit& hit, Answers& answers) {
  answers.add(uint64_t{hit.hit});
  answers.add(uint64_t{hit.undecided});
  answers.number(hit.time);
  answers.vector(hit.point);
  answers.vector(hit.normal);
  return hit.hit;
}

bool ask_ray(const Pair& pair, DistanceCache*, Answers& answers) {
  CastHit hit;
  answers.add(cast_ray(pair.a, pair.motion_a.start, pair.offset, pair.displacement, hit));
  return add_hit(hit, answers);
}

bool ask_shape(const Pair& pair, DistanceCache*, Answers& answers) {
  CastHit hit;
  answers.add(cast_shape(pair.b, pair.motion_b.start, pair.displacement, pair.a, pair.motion_a.start, hit));
  return add_hit(hit, answers);
}

/// The corners of a core from index `first` on, m, in its body's axes. False if it has fewer.
bool corners_of(const Convex& convex, int first, int count, Vec3<Real>* corner) {
  const int shift = k_metre_bits - 30 + convex.exponent;
  for (int i = 0; i < count; ++i) {
    CorePoint point;
    if (!core_vertex(convex, static_cast<uint8_t>(first + i), point)) return false;
    const auto metres = [shift](int32_t local) { return real_from_raw(int64_t{local} << shift); };
    corner[i] = {metres(point.local.x), metres(point.local.y), metres(point.local.z)};
  }
  return true;
}

/// Tests the first contacts of some of the pair's vertices with some triangles, and of some edges with each other.
template <class AskOne>
bool ask_features(const Pair& pair, Answers& answers, AskOne ask_one) {
  bool meets = false;
  for (int i = 0; i < 16; ++i) {
    const FeatureKind kind = i < 12 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
    const int split = kind == FeatureKind::vertex_face ? 1 : 2;
    Vec3<Real> corner[4];
    FeatureToi contact;
    if (!corners_of(pair.a, i % 4, split, corner) || !corners_of(pair.b, i / 4, 4 - split, corner + split)) continue;
    answers.add(ask_one(kind, corner, contact));
    answers.add(uint64_t{static_cast<uint32_t>(contact.outcome)});
    answers.number(contact.time);
    answers.add(uint64_t{contact.intervals});
    meets = meets || contact.outcome == ToiOutcome::hit;
  }
  return meets;
}

bool ask_feature_toi(const Pair& pair, DistanceCache*, Answers& answers) {
  return ask_features(pair, answers, [&pair](FeatureKind kind, const Vec3<Real>(&corner)[4], FeatureToi& contact) {
    return feature_toi(kind, corner, pair.motion_a, pair.motion_b, contact);
  });
}

/// B moves from its own pose to A's.
bool ask_feature_toi_screw(const Pair& pair, DistanceCache*, Answers& answers) {
  const PosePair a = {pair.motion_a.start, pair.motion_a.start}, b = {pair.motion_b.start, pair.motion_a.start};
  return ask_features(pair, answers, [&](FeatureKind kind, const Vec3<Real>(&corner)[4], FeatureToi& contact) {
    return feature_toi_screw(kind, corner, a, b, contact);
  });
}

/// Each corner of B moves on its own: through A to the place of the next corner there.
bool ask_feature_toi_linear(const Pair& pair, DistanceCache*, Answers& answers) {
  return ask_features(pair, answers, [&pair](FeatureKind kind, const Vec3<Real>(&corner)[4], FeatureToi& contact) {
    Vec3<Real> start[4], end[4];
    for (int i = 0; i < 4; ++i) {
      const bool of_a = i < (kind == FeatureKind::vertex_face ? 1 : 2);
      const Vec3<Real>& next = corner[i < 3 ? i + 1 : 3];
      start[i] = of_a ? corner[i] : corner[i] + pair.offset;
      end[i] = of_a ? corner[i] : next - pair.offset;
    }
    return feature_toi_linear(kind, start, end, contact);
  });
}

struct Question {
  const char* name;
  Ask ask;
  bool caches = false;
  bool polytopes = false;  ///< only polytopes have an answer: seven of eight pairs are polytopes
  /// Questions for polytopes only take long, so they get fewer pairs.
  constexpr uint32_t pairs() const { return polytopes ? k_pairs / 4 : k_pairs; }
};
constexpr Question k_questions[] = {
    {.name = "closest_points", .ask = ask_closest, .caches = true},
    {.name = "overlap", .ask = ask_overlap, .caches = true},
    {.name = "farther_than", .ask = ask_farther, .caches = true},
    {.name = "contact_points", .ask = ask_contact, .caches = true},
    {"toi_paper", ask_toi<ToiMethod::paper>},
    {"toi_first_order", ask_toi<ToiMethod::first_order>},
    {"toi_second_order", ask_toi<ToiMethod::second_order>},
    {"toi_corotating", ask_toi<ToiMethod::corotating>},
    {"toi_world_space", ask_toi<ToiMethod::world_space>},
    {"toi_constant_angular_velocity", ask_toi<ToiMethod::constant_angular_velocity>},
    {"toi_mirtich", ask_toi<ToiMethod::mirtich>},
    {"toi_baraff", ask_toi<ToiMethod::baraff>},
    {.name = "toi_feature_pairs", .ask = ask_toi<ToiMethod::feature_pairs>, .polytopes = true},
    {.name = "toi_redon", .ask = ask_toi<ToiMethod::redon>, .polytopes = true},
    {.name = "toi_canny", .ask = ask_toi<ToiMethod::canny>, .polytopes = true},
    {.name = "feature_toi", .ask = ask_feature_toi, .polytopes = true},
    {.name = "feature_toi_screw", .ask = ask_feature_toi_screw, .polytopes = true},
    {.name = "feature_toi_linear", .ask = ask_feature_toi_linear, .polytopes = true},
    {"cast_ray", ask_ray},
    {"cast_shape", ask_shape},
};

/// Overwrites the part of the stack that the next call of this depth uses.
__attribute__((noinline)) void scribble(uint32_t word) {
  volatile uint32_t stack[k_scribbled_bytes / sizeof(uint32_t)];
  for (volatile uint32_t& place : stack) place = word;
}

struct Outcome {
  uint64_t digest;
  uint32_t met;  ///< pairs that collide
};

Outcome ask_all(const Question& question, const Hulls& hulls, bool scribbles) {
  Random random(k_seed), noise(k_seed + 1);
  Answers answers;
  uint32_t met = 0;
  DistanceCache cache;  // each pair starts with the previous pair's content: any content must be safe
  Pair pair;
  for (uint32_t i = 0; i < question.pairs(); ++i) {
    if (question.polytopes && i % 8 != 0)
      make_polytopes(random, hulls, pair);
    else
      make_pair(random, hulls, pair);
    if (scribbles) scribble(static_cast<uint32_t>(noise.bits()));
    met += question.ask(pair, nullptr, answers) ? 1u : 0u;
    if (!question.caches) continue;
    if (scribbles) scribble(static_cast<uint32_t>(noise.bits()));
    question.ask(pair, &cache, answers);
    answers.add(uint64_t{cache.count});
    for (int k = 0; k < 4; ++k) answers.add(uint64_t{cache.vertex_a[k]} << 8 | cache.vertex_b[k]);
  }
  return {answers.digest(), met};
}

void print_digest(const Question& question, uint64_t digest) {
  machine_print("narrow_phase " DETENT_CONFIG_TEXT " ");
  machine_print(question.name);
  machine_print(" ");
  print_decimal(question.pairs());
  machine_print(" ");
  print_hex(digest, 16);
  machine_print("\n");
}

bool fail(const char* name, const char* problem) {
  machine_print(name);
  machine_print(": ");
  machine_print(problem);
  machine_print("\n");
  return false;
}

/// Prints the question's digest, and what is wrong with it.
bool examine(const Question& question, const Hulls& hulls) {
  const Outcome outcome = ask_all(question, hulls, false);
  print_digest(question, outcome.digest);
  const Outcome again = ask_all(question, hulls, true);
  if (again.digest != outcome.digest) {
    print_digest(question, again.digest);
    return fail(question.name, "the answers depend on what lay on the stack");
  }
  // If few pairs collide, or few do not, the digest would cover too little.
  const uint32_t met_min = question.pairs() / 8;
  if (outcome.met < met_min) return fail(question.name, "too few pairs meet");
  if (outcome.met > question.pairs() - met_min) return fail(question.name, "too few pairs do not meet");
  return true;
}

/// The question of this name. Null if there is none.
const Question* find_question(const char* name) {
  for (const Question& question : k_questions) {
    if (strcmp(question.name, name) == 0) return &question;
  }
  return nullptr;
}

}  // namespace

int machine_main(int argc, char** argv) {
  static Hulls hulls;
  make_hulls(hulls);
  bool good = true;
  if (argc == 1) {
    for (const Question& question : k_questions) good = examine(question, hulls) && good;
  }
  for (int i = 1; i < argc; ++i) {
    const Question* question = find_question(argv[i]);
    if (question == nullptr) {
      fail(argv[i], "no such question; usage: narrow_phase [QUESTION]...");
      return k_exit_usage;
    }
    good = examine(*question, hulls) && good;
  }
  return good ? k_exit_good : k_exit_bad;
}
