#pragma once
#include <detent/status.h>
#include <stdio.h>
#include <stdlib.h>

/// Continues if the status is ok; otherwise prints it and ends the program.
inline void check(detent::Status status, int line = __builtin_LINE()) {
  if (status == detent::Status::ok) return;
  printf("line %d: %s\n", line, detent::status_text(status));
  exit(1);
}

/// Ends the program if a claim of the page is false.
inline void check(bool claim, int line = __builtin_LINE()) {
  if (claim) return;
  printf("line %d: not so\n", line);
  exit(1);
}
