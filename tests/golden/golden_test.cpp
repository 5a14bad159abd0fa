// SPDX-License-Identifier: MIT
//
// Every golden vector against the table in golden.txt.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <golden/vectors.hpp>
#include <op/all_operators.hpp>

namespace fovea::golden {

void PrintTo(const Vector& vector, std::ostream* out) { *out << vector.name; }

namespace {

Workspace workspace;

std::string hexadecimal(std::uint32_t number) {
    char text[9] = {};
    std::snprintf(text, sizeof text, "%08x", static_cast<unsigned>(number));
    return text;
}

/// The lines "name checksum"; a # begins a comment.
std::map<std::string, std::string> read_table() {
    std::ifstream file(std::string(FOVEA_SOURCE_DIR) + "/tests/golden/golden.txt");
    std::map<std::string, std::string> table;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line.substr(0, line.find('#')));
        std::string name;
        std::string expected;
        if (words >> name >> expected) table[name] = expected;
    }
    return table;
}

std::vector<Vector> all_vectors() {
    std::vector<Vector> all;
    for_each_vector([&](const Vector& vector) { all.push_back(vector); });
    return all;
}

class GoldenVector : public testing::TestWithParam<Vector> {};

TEST_P(GoldenVector, HasTheChecksumOfTheTableWhateverRanBefore) {
    const std::map<std::string, std::string> table = read_table();
    const auto line = table.find(GetParam().name);
    ASSERT_NE(line, table.end()) << "golden.txt has no line for " << GetParam().name;
    EXPECT_EQ(hexadecimal(checksum(GetParam(), workspace)), line->second);
    for (auto& image : workspace.image)
        for (std::uint8_t& byte : image) byte = 0x5a;
    EXPECT_EQ(hexadecimal(checksum(GetParam(), workspace)), line->second);
}

INSTANTIATE_TEST_SUITE_P(, GoldenVector, testing::ValuesIn(all_vectors()), [](const auto& parameter) {
    std::string name = parameter.param.name;
    for (char& letter : name)
        if (letter == '/') letter = '_';
    return name;
});

TEST(GoldenVectors, AreOfTheOperatorsThatTheApplicationsHave) {
    const Span<const OperatorFamily> families = operator_families;
    const Span<const OperatorFamily> built = apps::all_operators();
    ASSERT_EQ(built.size(), families.size());
    for (std::ptrdiff_t i = 0; i < families.size(); ++i) {
        EXPECT_STREQ(built[i].name, families[i].name);
        ASSERT_EQ(built[i].operators.size(), families[i].operators.size()) << families[i].name;
        for (std::ptrdiff_t k = 0; k < families[i].operators.size(); ++k)
            EXPECT_STREQ(built[i].operators[k].name, families[i].operators[k].name);
    }
}

TEST(GoldenTable, HasNoLineWithoutAVector) {
    std::map<std::string, std::string> table = read_table();
    for (const Vector& vector : all_vectors()) table.erase(vector.name);
    for (const auto& [name, expected] : table) ADD_FAILURE() << "no vector is called " << name;
}

TEST(GoldenTable, HasDifferentChecksums) {
    // A vector that digests nothing, or the outputs of another one, would share its checksum.
    std::map<std::string, std::string> seen;
    for (const auto& [name, checksum] : read_table()) {
        const auto [place, fresh] = seen.emplace(checksum, name);
        EXPECT_TRUE(fresh) << name << " and " << place->second;
    }
}

TEST(GoldenVectors, GaugeThePlateToASmallFractionOfAPixel) {
    // The vectors of decision/ are worth something only if their part is measured, not refused.
    const ImageView<Gray8> image = part_picture(workspace, 0);
    const PlateRecipe made =
        plate_recipe(image, Plate{}, workspace.scratch_span(), workspace.regions, workspace.holes);
    ASSERT_EQ(made.status, Status::ok);
    List<PartResult, 3> parts;
    ASSERT_EQ(gauge(image, made.recipe, workspace.scratch_span(), parts), Status::ok);
    ASSERT_EQ(parts.size(), 1);
    EXPECT_EQ(parts[0].pose.orientation, Status::ok);
    for (int i = 0; i < parts[0].feature_count; ++i) {
        const Feature& feature = made.recipe.features[i];
        ASSERT_EQ(parts[0].features[i].status, Status::ok) << feature.name;
        const std::int64_t error =
            (parts[0].features[i].measurement.value - feature.tolerance.nominal).millionths;
        // Half a degree on edges of ten pixels, 1/20 px else.
        EXPECT_LT(error < 0 ? -error : error, feature.kind == FeatureKind::angle ? 500000 : 50000)
            << feature.name;
    }
}

}  // namespace
}  // namespace fovea::golden
