#include <ports/bare/memory.h>
#include <ports/bare/semihosting.h>
#include <ports/bare/start.h>
#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

namespace {
constexpr uint32_t k_command_line_bytes_max = 512;
constexpr int k_arguments_max = 16;
constexpr char k_argument_end = '\x1f';

char command_line[k_command_line_bytes_max];
char* arguments[k_arguments_max + 1];

// The command line is a sequence of arguments, each ended by k_argument_end (toolchains/run-bare).
int split_command_line() {
  const struct {
    char* bytes;
    uint32_t byte_count;
  } block = {command_line, k_command_line_bytes_max};
  if (semihosting(Semihosting::command_line, &block) != 0) machine_panic("command line longer than 512 bytes");
  int count = 0;
  char* next = command_line;
  for (char* end = command_line; *end != '\0'; ++end) {
    if (*end != k_argument_end) continue;
    if (count == k_arguments_max) machine_panic("more than 16 arguments");
    *end = '\0';
    arguments[count++] = next;
    next = end + 1;
  }
  return count;
}
}  // namespace

void machine_start() {
  memcpy(link_data, link_data_initial, static_cast<uint32_t>(link_data_end - link_data));
  memset(link_bss, 0, static_cast<uint32_t>(link_bss_end - link_bss));
  paint_stack();
  for (MachineConstructor* constructor = link_constructors; constructor < link_constructors_end; ++constructor) {
    (*constructor)();
  }
  const int argument_count = split_command_line();
  const int code = machine_main(argument_count, arguments);
  if (machine_stack_used() >= machine_memory().stack_bytes) machine_panic("stack overflow");
  machine_exit(code);
}

void machine_fault(uint32_t address) {
  machine_print("fault at 0x");
  print_hex(address, 8);
  machine_print("\n");
  machine_panic("processor fault");
}
