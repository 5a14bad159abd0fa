// SPDX-License-Identifier: MIT
//
// What the words of hal/storage.hpp promise, as tests that every storage takes. Host tests only.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/hal/storage.hpp>

namespace fovea::test {

using StoredBytes = std::vector<std::uint8_t>;

template <class Storage>
Status save(Storage& storage, const std::string& name, const StoredBytes& bytes) {
    return storage.save(name.c_str(), {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())});
}

/// The bytes under a name; the test fails if there are none.
template <class Storage>
StoredBytes loaded(Storage& storage, const std::string& name) {
    const Result<Span<const std::uint8_t>> bytes = storage.load(name.c_str());
    EXPECT_TRUE(bytes.ok()) << name << ": " << describe(bytes.status());
    return bytes ? StoredBytes(bytes->begin(), bytes->end()) : StoredBytes();
}

/// How GoogleTest names the one fixture of a suite.
struct ByContract {
    template <class Fixture>
    static std::string GetName(int) {
        return "keeps_the_contract";
    }
};

/// A suite for the fixture of a storage, which has storage() and name(text), a name that it may use.
template <class Fixture>
class StorageContract : public Fixture {};

TYPED_TEST_SUITE_P(StorageContract);

TYPED_TEST_P(StorageContract, GivesBackWhatWasSaved) {
    const StoredBytes bytes = {0, 255, 10, 13, 0, 26, 128};
    ASSERT_EQ(save(this->storage(), this->name("a"), bytes), Status::ok);
    EXPECT_EQ(loaded(this->storage(), this->name("a")), bytes);
    EXPECT_EQ(loaded(this->storage(), this->name("a")), bytes) << "the second time too";
}

TYPED_TEST_P(StorageContract, SaysThatANameIsUnknown) {
    EXPECT_EQ(this->storage().load(this->name("nothing").c_str()).status(), Status::not_found);
}

TYPED_TEST_P(StorageContract, KeepsEmptyBytesApartFromNone) {
    ASSERT_EQ(save(this->storage(), this->name("empty"), {}), Status::ok);
    EXPECT_EQ(loaded(this->storage(), this->name("empty")), StoredBytes());
}

TYPED_TEST_P(StorageContract, ReplacesLongBytesByShortOnes) {
    ASSERT_EQ(save(this->storage(), this->name("a"), StoredBytes(1000, 7)), Status::ok);
    ASSERT_EQ(save(this->storage(), this->name("a"), {1, 2}), Status::ok);
    EXPECT_EQ(loaded(this->storage(), this->name("a")), (StoredBytes{1, 2}));
}

TYPED_TEST_P(StorageContract, KeepsNamesApart) {
    ASSERT_EQ(save(this->storage(), this->name("a"), {1}), Status::ok);
    ASSERT_EQ(save(this->storage(), this->name("b"), {2}), Status::ok);
    ASSERT_EQ(save(this->storage(), this->name("a b.c"), {3}), Status::ok);
    EXPECT_EQ(loaded(this->storage(), this->name("a")), StoredBytes{1});
    EXPECT_EQ(loaded(this->storage(), this->name("b")), StoredBytes{2});
    EXPECT_EQ(loaded(this->storage(), this->name("a b.c")), StoredBytes{3});
}

TYPED_TEST_P(StorageContract, HoldsWhatItLoadedWhileItSaves) {
    ASSERT_EQ(save(this->storage(), this->name("a"), {1, 2, 3}), Status::ok);
    const Result<Span<const std::uint8_t>> bytes = this->storage().load(this->name("a").c_str());
    ASSERT_TRUE(bytes.ok());
    ASSERT_EQ(save(this->storage(), this->name("a"), {9}), Status::ok);
    ASSERT_EQ(save(this->storage(), this->name("b"), {8}), Status::ok);
    EXPECT_EQ(StoredBytes(bytes->begin(), bytes->end()), (StoredBytes{1, 2, 3}));
}

TYPED_TEST_P(StorageContract, KeepsBytesOfEveryLengthAroundItsBuffers) {
    for (const std::size_t size : {std::size_t{1}, std::size_t{4096}, std::size_t{65535}, std::size_t{65536},
                                   std::size_t{65537}, std::size_t{131072}, std::size_t{300001}}) {
        StoredBytes bytes(size);
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
        ASSERT_EQ(save(this->storage(), this->name("long"), bytes), Status::ok) << size;
        EXPECT_TRUE(loaded(this->storage(), this->name("long")) == bytes) << size;
    }
}

REGISTER_TYPED_TEST_SUITE_P(StorageContract, GivesBackWhatWasSaved, SaysThatANameIsUnknown,
                            KeepsEmptyBytesApartFromNone, ReplacesLongBytesByShortOnes, KeepsNamesApart,
                            HoldsWhatItLoadedWhileItSaves, KeepsBytesOfEveryLengthAroundItsBuffers);

}  // namespace fovea::test
