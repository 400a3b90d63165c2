#pragma once
#include <detent/config.h>
#include <gtest/gtest.h>

/// As TEST, for a source that is compiled once per configuration and linked with its siblings: the suite's name gets
/// the configuration's, e.g. world_fx64.name_of_the_test.
#define DETENT_TEST(suite, name) DETENT_TEST_IN(suite, DETENT_NAMESPACE, name)
#define DETENT_TEST_IN(suite, config, name) DETENT_TEST_JOINED(suite, config, name)
#define DETENT_TEST_JOINED(suite, config, name) TEST(suite##_##config, name)

/// Reads as `ok`, or as the status that came instead.
#define EXPECT_OK(call) EXPECT_STREQ(detent::status_text(call), "ok")
#define ASSERT_OK(call) ASSERT_STREQ(detent::status_text(call), "ok")
