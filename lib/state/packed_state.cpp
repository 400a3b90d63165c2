#include "state/packed_state.h"

#include <detent/rollback.h>
#include <string.h>

#include "base/bytes.h"
#include "state/used.h"

// Format: the header and the world unchanged, the number of assets in use, then the used elements of each section. An
// element with optional parts begins with a byte that has a flag for each of these parts: 1 if the part follows, 0 if
// it is omitted because it is zero.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_front = sizeof(BlockHeader) + sizeof(WorldState);

template <uint32_t count>
bool is_zero(const uint8_t* bytes) {
  static_assert(count % 4 == 0);
  uint64_t any = 0;
  for (uint32_t at = 0; at + 8 <= count; at += 8) any |= load_u64(bytes + at);
  uint32_t last = 0;
  if (count % 8 != 0) memcpy(&last, bytes + count - 4, sizeof last);
  return (any | last) == 0;
}

class Packer {
 public:
  explicit Packer(uint8_t* at) : at_(at) {}
  const uint8_t* at() const { return at_; }

  void all(const void* from, uint32_t count) {
    memcpy(at_, from, count);
    at_ += count;
  }
  void begin_element() {
    flags_ = at_++;
    *flags_ = 0;
    bit_ = 0;
  }
  template <uint32_t first, uint32_t end>
  void part(const uint8_t* element) {
    all(element + first, end - first);
  }
  template <uint32_t first, uint32_t end>
  void rare_part(const uint8_t* element) {
    const uint32_t there = is_zero<end - first>(element + first) ? 0 : 1;
    *flags_ = static_cast<uint8_t>(*flags_ | there << bit_++);
    memcpy(at_, element + first, end - first);  // if this part is omitted, the next part overwrites it
    at_ += there * (end - first);
  }

 private:
  uint8_t* at_;
  uint8_t* flags_ = nullptr;
  uint32_t bit_ = 0;
};

class Unpacker {
 public:
  explicit Unpacker(const uint8_t* at) : at_(at) {}

  void all(void* to, uint32_t count) {
    memcpy(to, at_, count);
    at_ += count;
  }
  void begin_element() { flags_ = *at_++; }
  template <uint32_t first, uint32_t end>
  void part(uint8_t* element) {
    all(element + first, end - first);
  }
  template <uint32_t first, uint32_t end>
  void rare_part(uint8_t* element) {
    if ((flags_ & 1) != 0)
      part<first, end>(element);
    else
      memset(element + first, 0, end - first);
    flags_ >>= 1;
  }

 private:
  const uint8_t* at_;
  uint32_t flags_ = 0;
};

/// The parts of an element, in order, for each section with optional parts. `Mover` is Packer or Unpacker.
struct MotionParts {
  template <class Mover, class Byte>
  static void move(Mover& mover, Byte* motion) {
    constexpr uint32_t k_pending = __builtin_offsetof(BodyMotion, pending_velocity);
    mover.template part<0, k_pending>(motion);
    mover.template rare_part<k_pending, sizeof(BodyMotion)>(motion);
  }
};
struct ContactParts {
  template <class Mover, class Byte>
  static void move(Mover& mover, Byte* contact) {
    constexpr uint32_t k_feature = __builtin_offsetof(ContactState, feature);
    constexpr uint32_t k_impulse = __builtin_offsetof(ContactState, normal_impulse);
    constexpr uint32_t k_friction = __builtin_offsetof(ContactState, friction_impulse);
    mover.template part<0, k_feature + sizeof(uint32_t)>(contact);
    mover.template rare_part<k_feature + sizeof(uint32_t), k_impulse>(contact);
    mover.template part<k_impulse, k_impulse + sizeof(Real)>(contact);
    mover.template rare_part<k_impulse + sizeof(Real), k_friction>(contact);
    mover.template part<k_friction, sizeof(ContactState)>(contact);
  }
};
struct ManifoldParts {
  template <class Mover, class Byte>
  static void move(Mover& mover, Byte* manifold) {
    mover.template rare_part<0, sizeof(ManifoldState)>(manifold);
  }
};

/// Packs or unpacks the elements of a section with optional parts. The mover is passed by value, because the compiler
/// would have to assume that written bytes alias a mover passed by reference.
template <class Parts, class Mover, class Byte>
Mover move_elements(Mover mover, Byte* element, uint32_t count, uint32_t element_bytes) {
  for (Byte* const end = element + count * element_bytes; element != end; element += element_bytes) {
    mover.begin_element();
    Parts::move(mover, element);
  }
  return mover;
}

/// Packs or unpacks all sections after the world.
template <class Mover, class Byte>
void move_sections(Mover& mover, const StateView<Byte>& state, const UsedCounts& counts) {
  Byte* const block = reinterpret_cast<Byte*>(&state.header);
  for (uint32_t i = 2; i < k_section_count; ++i) {
    const Section& section = k_sections[i];
    Byte* const first = block + state.layout.*section.offset;
    if (section.offset == &Layout::motions)
      mover = move_elements<MotionParts>(mover, first, counts.of[i], sizeof(BodyMotion));
    else if (section.offset == &Layout::contacts)
      mover = move_elements<ContactParts>(mover, first, counts.of[i], sizeof(ContactState));
    else if (section.offset == &Layout::manifolds)
      mover = move_elements<ManifoldParts>(mover, first, counts.of[i], sizeof(ManifoldState));
    else
      mover.all(first, counts.of[i] * section.element_bytes);
  }
}

}  // namespace

uint32_t pack_state(const StateView<const uint8_t>& state, uint8_t* bytes) {
  const uint32_t assets = used_assets(state);
  Packer packer(bytes);
  packer.all(&state.header, k_front);
  packer.all(&assets, sizeof assets);
  move_sections(packer, state, used_counts(state));
  return static_cast<uint32_t>(packer.at() - bytes);
}

void unpack_state(const uint8_t* bytes, const StateView<uint8_t>& to) {
  const UsedCounts before = used_counts(const_view_of(reinterpret_cast<const uint8_t*>(&to.header)));
  uint32_t assets = 0;
  Unpacker unpacker(bytes + sizeof(BlockHeader));
  unpacker.all(&to.world, sizeof(WorldState));
  unpacker.all(&assets, sizeof assets);
  const UsedCounts now = used_counts(to.world, assets, to.manifolds.count != 0);
  move_sections(unpacker, to, now);
  clear_unused(to, before, now);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
