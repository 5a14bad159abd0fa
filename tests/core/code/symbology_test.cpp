// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>
#include <string>

#include <fovea/code/symbology.hpp>

namespace fovea::test {
namespace {

TEST(Symbology, HasANameAndALetterOfItsOwn) {
    std::set<std::string> names;
    for (int i = 0; i < symbology_count; ++i) {
        const auto symbology = static_cast<Symbology>(i);
        EXPECT_TRUE(names.insert(name(symbology)).second) << i;
        EXPECT_NE(aim_letter(symbology), 'X') << i;
    }
    EXPECT_EQ(names.count("unknown"), 0U);
    // ISO/IEC 15424, table 1.
    EXPECT_EQ(aim_letter(Symbology::upc_e), 'E');
    EXPECT_EQ(aim_letter(Symbology::code_128), 'C');
    EXPECT_EQ(aim_letter(Symbology::data_matrix), 'd');
    EXPECT_EQ(aim_letter(Symbology::qr), 'Q');
    EXPECT_STREQ(name(static_cast<Symbology>(200)), "unknown");
}

TEST(SymbologySet, HoldsWhatWasPutIntoIt) {
    EXPECT_TRUE(SymbologySet().empty());
    const SymbologySet two = SymbologySet(Symbology::qr) | Symbology::ean_8;
    EXPECT_TRUE(two.contains(Symbology::qr));
    EXPECT_TRUE(two.contains(Symbology::ean_8));
    EXPECT_FALSE(two.contains(Symbology::ean_13));
    EXPECT_EQ(two & Symbology::qr, SymbologySet(Symbology::qr));
    EXPECT_NE(two, SymbologySet::all());
    for (int i = 0; i < symbology_count; ++i) {
        EXPECT_TRUE(SymbologySet::all().contains(static_cast<Symbology>(i)));
    }
}

}  // namespace
}  // namespace fovea::test
