#include <ports/machine.h>
#include <ports/print.h>
#include <string.h>

// One program, one check for each first argument; see CMakeLists.txt.
namespace {
constexpr int k_passed = 0;
constexpr int k_failed = 1;

int fail(const char* what) {
  machine_print("failed: ");
  machine_print(what);
  machine_print("\n");
  return k_failed;
}

// bytes.bin contains every byte value, then the bytes that a text mode would translate or treat as the end.
constexpr char k_translated[] = "\r\n\x1a\r\n";
constexpr uint32_t k_byte_count = 256 + sizeof k_translated - 1;

uint8_t expected_byte(uint32_t index) {
  return static_cast<uint8_t>(index < 256 ? index : static_cast<uint8_t>(k_translated[index - 256]));
}

int check_arguments(int argc, char** argv) {
  const char* const expected[] = {"arguments", "two words", "a,b,,c", "quote\"s", "$HOME*\\"};
  constexpr int k_count = sizeof expected / sizeof expected[0];
  for (int index = 1; index < argc; ++index) {
    machine_print("argument: ");
    machine_print(argv[index]);
    machine_print("\n");
  }
  if (argc != k_count + 1) return fail("the number of arguments");
  for (int index = 0; index < k_count; ++index) {
    if (strcmp(argv[index + 1], expected[index]) != 0) return fail(expected[index]);
  }
  return k_passed;
}

int check_read(const char* path) {
  const MachineFile file = machine_open(path, MachineMode::read);
  if (!file.is_open()) return fail("open");
  if (machine_file_bytes(file) != static_cast<int32_t>(k_byte_count)) return fail("the size");
  uint8_t bytes[k_byte_count + 1];
  if (machine_read(file, bytes, 10) != 10) return fail("a short read");
  if (machine_read(file, bytes + 10, sizeof bytes - 10) != k_byte_count - 10) return fail("a read over the end");
  for (uint32_t index = 0; index < k_byte_count; ++index) {
    if (bytes[index] != expected_byte(index)) return fail("a byte");
  }
  if (machine_read(file, bytes, 1) != 0) return fail("a read at the end");
  if (!machine_seek(file, 200)) return fail("seek");
  if (machine_read(file, bytes, 1) != 1 || bytes[0] != 200) return fail("the byte after a seek");
  return machine_close(file) ? k_passed : fail("close");
}

int check_write(const char* path) {
  uint8_t bytes[k_byte_count];
  for (uint32_t index = 0; index < k_byte_count; ++index) bytes[index] = expected_byte(index);
  const MachineFile file = machine_open(path, MachineMode::write);
  if (!file.is_open()) return fail("open");
  bytes[20] = 0;
  if (machine_write(file, bytes, k_byte_count) != k_byte_count) return fail("write");
  if (!machine_seek(file, 20)) return fail("seek");
  bytes[20] = expected_byte(20);
  if (machine_write(file, bytes + 20, 1) != 1) return fail("a write after a seek");
  if (!machine_close(file)) return fail("close");
  return check_read(path);
}

int check_missing(const char* path) {
  return machine_open(path, MachineMode::read).is_open() ? fail("a missing file was opened") : k_passed;
}

struct Constructed {
  uint32_t value;
  explicit Constructed(uint32_t seed) : value(seed * 3) {}
};
volatile uint32_t seed_of_construction = 7;  // in initialised data, which start-up must have copied before
Constructed constructed(seed_of_construction);
uint8_t zeroed[64];

int check_constructors() {
  if (constructed.value != 21) return fail("a constructor");
  for (const uint8_t& byte : zeroed) {
    if (*static_cast<const volatile uint8_t*>(&byte) != 0) return fail("zeroed data");
  }
  return k_passed;
}

int check_layout(const char* byte_order, const char* word_bits) {
  const uint32_t value = 0x01020304;
  uint8_t first;
  memcpy(&first, &value, 1);
  if (strcmp(byte_order, first == 1 ? "big" : "little") != 0) return fail("the byte order");
  if (strcmp(word_bits, sizeof(void*) == 8 ? "64" : "32") != 0) return fail("the word's bits");
  return k_passed;
}

// Uses arrays, so that the compiler uses its vector unit, whose float rules may differ.
int check_denormals() {
  constexpr uint32_t k_smallest_normal = 0x00800000;
  float sums[16];
  float halves[16];
  for (uint32_t index = 0; index < 16; ++index) {
    const uint32_t bits = k_smallest_normal + index;
    memcpy(&sums[index], &bits, sizeof bits);
    halves[index] = 0.5f;
  }
  asm volatile("" ::"r"(sums), "r"(halves) : "memory");
  for (uint32_t index = 0; index < 16; ++index) sums[index] *= halves[index];
  asm volatile("" ::"r"(sums) : "memory");
  for (uint32_t index = 0; index < 16; ++index) {
    uint32_t bits;
    memcpy(&bits, &sums[index], sizeof bits);
    const uint32_t half_to_even = (k_smallest_normal + index) / 2 + (index % 4 == 3 ? 1 : 0);
    if (bits != half_to_even) return fail("a denormal");
  }
  return k_passed;
}

void use_stack(uint32_t byte_count) {
  volatile uint8_t* const bytes = static_cast<volatile uint8_t*>(__builtin_alloca(byte_count));
  for (uint32_t index = 0; index < byte_count; ++index) bytes[index] = 1;
}

int check_memory() {
  const MachineMemory memory = machine_memory();
  machine_print("flash ");
  print_decimal(memory.flash_bytes);
  machine_print(" ram ");
  print_decimal(memory.ram_bytes);
  machine_print(" stack ");
  print_decimal(memory.stack_bytes);
  machine_print(" used ");
  const uint32_t used = machine_stack_used();
  print_decimal(used);
  machine_print("\n");
  if (memory.stack_bytes == 0) return used == 0 ? k_passed : fail("a stack without a size");
  if (memory.flash_bytes < 1000 || memory.ram_bytes < sizeof zeroed) return fail("the program's size");
  if (used == 0 || used > 1024) return fail("the stack used so far");
  use_stack(3000);
  const uint32_t used_deep = machine_stack_used();
  if (used_deep < 3000 || used_deep > used + 3100) return fail("the stack used by a deep call");
  return k_passed;
}

int check_print() {
  print_decimal(0);
  machine_print(" ");
  print_decimal(UINT64_MAX);
  machine_print(" ");
  print_hex(0xAA00C0FFEE, 8);
  machine_print(" ");
  print_hex(0x0123456789ABCDEF, 16);
  machine_print("\n");
  return k_passed;
}

int exit_code(const char* digits) {
  int code = 0;
  for (; *digits != '\0'; ++digits) code = code * 10 + (*digits - '0');
  return code;
}
}  // namespace

int machine_main(int argc, char** argv) {
  const char* const name = argc > 1 ? argv[1] : "";
  const auto is = [&](const char* check, int parameter_count) {
    return strcmp(name, check) == 0 && argc >= 2 + parameter_count;
  };
  if (is("arguments", 0)) return check_arguments(argc, argv);
  if (is("constructors", 0)) return check_constructors();
  if (is("denormals", 0)) return check_denormals();
  if (is("exit", 1)) return exit_code(argv[2]);
  if (is("fault", 0)) __builtin_trap();
  if (is("layout", 2)) return check_layout(argv[2], argv[3]);
  if (is("memory", 0)) return check_memory();
  if (is("missing", 1)) return check_missing(argv[2]);
  if (is("overflow", 0)) use_stack(machine_memory().stack_bytes - 100);
  if (is("panic", 0)) machine_panic("asked for");
  if (is("print", 0)) return check_print();
  if (is("read", 1)) return check_read(argv[2]);
  if (is("write", 1)) return check_write(argv[2]);
  return fail("no such check");
}
