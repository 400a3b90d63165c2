#include <ports/machine.h>
#include <ports/print.h>

#include "crib.h"

// What a crib needs in memory on a microcontroller: the world's block by its parts, what data the program has beside
// it, and the stack. Only what boxes on the ground need is linked. Prints a line `name,value` for each figure, in
// bytes.

namespace {

using namespace detent;

constexpr uint32_t k_ticks = 60;

WorldStorage<k_crib_capacity> storage;

void print_row(const char* name, uint32_t value) {
  machine_print(name);
  machine_print(",");
  print_decimal(value);
  machine_print("\n");
}

void print_block() {
  constexpr Capacity k_capacity = k_crib_capacity;
  constexpr uint32_t k_bodies = k_capacity.bodies, k_contacts = k_capacity.contacts;
  bool fits = false;
  const Layout layout = layout_of(k_capacity, fits);
  print_row("boxes", crib_planks());
  print_row("contacts", k_contacts);
  print_row("world_bytes", layout.bytes);
  // The order in which they lie in the block.
  print_row("state of world and bodies", layout.contacts);
  print_row("state of contacts", layout.persistent_bytes - layout.contacts);
  print_row("bounds and resting tree", layout.pairs - layout.cache);
  print_row("pairs", layout.contact_work - layout.pairs);
  print_row("contacts at work", layout.islands - layout.contact_work);
  print_row("islands", layout.sweeps - layout.islands);
  print_row("sweeps", layout.body_work - layout.sweeps);
  print_row("bodies at work", layout.contact_order - layout.body_work);
  const uint32_t order_end = layout.contact_sort + (layout.contact_sort - layout.contact_order);
  print_row("order of the solve", order_end - layout.contact_order);
  print_row("impacts beyond those two", layout.bytes - order_end);
  print_row("a body", (world_bytes({k_bodies + 64, k_contacts, 0, false}) - layout.bytes) / 64);
  print_row("a contact", (world_bytes({k_bodies, k_contacts + 64, 0, false}) - layout.bytes) / 64);
}

}  // namespace

int machine_main(int, char**) {
  World world;
  WorldDef def;
  def.sleeping = false;
  def.continuous = false;
  def.contact_recycle_distance = Real(0.0);
  bool good = storage.create(def, {}, feature_table<Features::box | Features::half_space>, world) == Status::ok;
  good = good && build_crib(world) == Status::ok;
  StepReport report;
  for (uint32_t tick = 0; tick < k_ticks && good; ++tick) {
    report = step(world);
    good = report.complete();
  }
  const uint32_t stack = machine_stack_used();
  print_block();
  print_row("flash", machine_memory().flash_bytes);
  print_row("data and bss", machine_memory().ram_bytes - static_cast<uint32_t>(sizeof storage));
  print_row("stack", stack);
  return good && report.contacts.count == crib_contacts() ? 0 : 1;
}
