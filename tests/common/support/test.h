#pragma once
#include <detent/config.h>
#include <gtest/gtest.h>

/// Like TEST, for a source that is compiled once for each configuration and linked with the others: adds the
/// configuration to the suite's name, as in world_fx64.name_of_the_test.
#define DETENT_TEST(suite, name) DETENT_TEST_IN(suite, DETENT_NAMESPACE, name)
#define DETENT_TEST_IN(suite, config, name) DETENT_TEST_JOINED(suite, config, name)
#define DETENT_TEST_JOINED(suite, config, name) TEST(suite##_##config, name)

/// A failure prints the returned status.
#define EXPECT_OK(call) EXPECT_STREQ(detent::status_text(call), "ok")
#define ASSERT_OK(call) ASSERT_STREQ(detent::status_text(call), "ok")
