#include <ports/machine.h>

void machine_panic(const char* reason) {
  machine_print("panic: ");
  machine_print(reason);
  machine_print("\n");
  machine_exit(k_machine_panic_code);
}
