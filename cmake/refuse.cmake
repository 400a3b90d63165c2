# Targets whose arithmetic is not IEEE-correct are refused here, with the reason, and not special-cased anywhere.

if("f64" IN_LIST DETENT_CONFIGS AND DETENT_SOFT_DOUBLE_FAULT)
  message(FATAL_ERROR "detent: f64 is refused on this target: its compiler's soft double addition (__aeabi_dadd) rounds "
    "wrongly at an exponent gap of 33, so the digests would differ. Leave f64 out of DETENT_CONFIGS.")
endif()
