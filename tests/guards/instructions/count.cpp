#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

#include "counted_step.h"
#include "crib.h"
#include "timer.h"

// What a tick of a crib costs on a Cortex-M3, in instructions: all of it, and its stages (counted_step.h). QEMU runs it
// with
// `-icount shift=6`, so that the board's timer counts instructions. Prints a line `name,value` for each figure.

namespace {

using namespace detent;

constexpr uint32_t k_ticks_before = 60;

WorldStorage<k_crib_capacity> storage, copy;

void print_row(const char* name, uint64_t value) {
  machine_print(name);
  machine_print(",");
  print_decimal(value);
  machine_print("\n");
}

template <class Call>
__attribute__((noinline)) uint32_t ticks_of(const Call& call) {
  const uint32_t before = timer_value();
  call();
  return before - timer_value();
}

}  // namespace

int machine_main(int, char**) {
  start_timer();
  const uint32_t none = ticks_of([] {});
  const uint32_t loop = ticks_of([] {
    int32_t left = 1000;  // one instruction, then two each
    __asm__ volatile("1: subs %0, #1\n bne 1b" : "+r"(left)::"cc");
  });
  if (instructions_of(loop - none) != 2001) machine_panic("the timer does not count instructions");

  WorldDef def;
  def.sleeping = false;
  def.contact_recycle_distance = Real(0.0);
  World world;
  if (storage.create(def, {}, k_counted_features, world) != Status::ok) machine_panic("the world is refused");
  if (build_crib(world) != Status::ok) machine_panic("a plank is refused");
  for (uint32_t tick = 0; tick < k_ticks_before; ++tick) {
    if (!step(world).complete()) machine_panic("something was lost");
  }
  World other = world;
  other.block = copy.block;
  memcpy(copy.block, storage.block, sizeof copy.block);

  StepReport report;
  const uint32_t whole = ticks_of([&] { report = step(world); });
  memset(&stage_ticks, 0, sizeof stage_ticks);
  const StepReport counted = counted_step(other);
  if (digest(world) != digest(other) || counted.contacts.count != report.contacts.count)
    machine_panic("the two steps differ");
  if (report.contacts.count != crib_contacts() || report.awake != crib_planks())
    machine_panic("the crib has come apart");

  print_row("contacts", report.contacts.count);
  print_row("points", report.contacts.points);
  print_row("contact_substeps", report.contacts.substeps);
  print_row("step", instructions_of(whole - none));
  for (uint32_t i = 0; i < k_stage_count; ++i) {
    print_row(k_stage_names[i], instructions_of(stage_ticks.ticks[i] - uint64_t{stage_ticks.calls[i]} * none));
  }
  return 0;
}
