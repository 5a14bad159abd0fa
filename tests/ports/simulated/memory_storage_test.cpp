// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/simulated/memory_storage.hpp>
#include <support/storage_contract.hpp>

namespace fovea::test {
namespace {

class InMemory : public testing::Test {
protected:
    simulated::MemoryStorage& storage() { return storage_; }
    std::string name(const std::string& text) const { return text; }

private:
    simulated::MemoryStorage storage_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(MemoryStorage, StorageContract, InMemory, ByContract);

TEST(MemoryStorage, RefusesOneNameAsABrokenMediumWould) {
    simulated::MemoryStorage storage;
    ASSERT_EQ(save(storage, "broken", {1}), Status::ok);
    storage.refused = "broken";
    EXPECT_EQ(storage.load("broken").status(), Status::io_error);
    EXPECT_EQ(save(storage, "broken", {2}), Status::io_error);
    EXPECT_STRNE(storage.problem(), "");
    EXPECT_EQ(save(storage, "other", {3}), Status::ok);
    storage.refused.clear();
    EXPECT_EQ(loaded(storage, "broken"), StoredBytes{1}) << "after an error the old bytes stand";
}

}  // namespace
}  // namespace fovea::test
