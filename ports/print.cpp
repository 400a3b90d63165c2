#include <ports/machine.h>
#include <ports/print.h>

void print_decimal(uint64_t value) {
  char text[21];
  char* first = text + sizeof text - 1;
  *first = '\0';
  do {
    *--first = static_cast<char>('0' + value % 10);
    value /= 10;
  } while (value != 0);
  machine_print(first);
}

void print_hex(uint64_t value, uint32_t digits) {
  char text[17];
  char* first = text + sizeof text - 1;
  *first = '\0';
  for (uint32_t digit = 0; digit < digits; ++digit) {
    *--first = "0123456789abcdef"[value & 15];
    value >>= 4;
  }
  machine_print(first);
}
