#pragma once
#include <stdint.h>

/// The symbols of link.ld.in. Only their addresses are meaningful; those named _bytes are sizes, not addresses.
extern "C" {
using MachineConstructor = void (*)();
extern MachineConstructor link_constructors[];
extern MachineConstructor link_constructors_end[];
extern uint8_t link_data_initial[];
extern uint8_t link_data[];
extern uint8_t link_data_end[];
extern uint8_t link_bss[];
extern uint8_t link_bss_end[];
extern uint8_t link_stack_top[];
extern uint8_t link_flash_bytes[];
extern uint8_t link_ram_bytes[];
}

/// Fills the unused stack with a pattern, so that machine_stack_used can find the deepest use.
void paint_stack();
