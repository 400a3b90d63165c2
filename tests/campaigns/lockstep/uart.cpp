#include <ports/machine.h>

#include "examples/scenes/scene.h"

/// Records a scene through the serial port of an MPS2 board (AN385, AN386, AN500). A microcontroller needs a world, a
/// buffer of one chunk, and a sink that waits until the port has taken each byte.

namespace {

using namespace detent;

constexpr uint32_t k_ticks = 300;  // tests/campaigns/lockstep/regenerate: the length of the committed recording

/// Source: Arm, "Cortex-M System Design Kit", DDI0479, 4.3, "APB UART".
struct Uart {
  volatile uint32_t data, state, control, interrupts, baud_divider;
};
constexpr uintptr_t k_uart_address = 0x40004000;
constexpr uint32_t k_transmitter_full = 1;    // in `state`
constexpr uint32_t k_enable_transmitter = 1;  // in `control`
constexpr uint32_t k_baud_divider = 217;      // 25 MHz / 217 = 115,200 baud

Status send(void* context, const uint8_t* bytes, uint32_t count) {
  Uart& uart = *static_cast<Uart*>(context);
  for (uint32_t i = 0; i < count; ++i) {
    while ((uart.state & k_transmitter_full) != 0) {
    }
    uart.data = bytes[i];
  }
  return Status::ok;
}

alignas(8) uint8_t block[65536];
uint8_t buffer[k_recording_buffer_bytes];

}  // namespace

int machine_main(int, char**) {
  Uart& uart = *reinterpret_cast<Uart*>(k_uart_address);
  uart.baud_divider = k_baud_divider;
  uart.control = k_enable_transmitter;

  const Scene& scene = *find_scene("tiny");
  World world;
  if (create_world(block, sizeof block, scene.world(), {.assets = scene_assets()}, world) != Status::ok) return 1;
  Recorder recorder(world, {send, &uart}, buffer, sizeof buffer);
  scene.build(recorder);
  if (recorder.begin() != Status::ok) return 1;
  for (uint32_t tick = 0; tick < k_ticks; ++tick) {
    if (scene.before_tick != nullptr) scene.before_tick(recorder, tick);
    recorder.step();
  }
  return recorder.end() == Status::ok ? 0 : 1;
}
