#pragma once
#include <detent/status.h>
#include <stdio.h>
#include <stdlib.h>

/// What the pages' programs do with a status: go on if it is ok, or else say what it is and stop.
inline void check(detent::Status status, int line = __builtin_LINE()) {
  if (status == detent::Status::ok) return;
  printf("line %d: %s\n", line, detent::status_text(status));
  exit(1);
}

/// And with what a page claims.
inline void check(bool claim, int line = __builtin_LINE()) {
  if (claim) return;
  printf("line %d: not so\n", line);
  exit(1);
}
