// SPDX-License-Identifier: MIT
//
// Any bytes as a recipe: as they are, and as fields with a head and a checksum that are right. What is
// refused leaves the recipe as it was; what is read can be written, and reads the same again.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/decision/compiled_recipe.hpp>

namespace {

using namespace fovea;
using Bytes = std::vector<std::uint8_t>;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

Bytes written(const RecipeOf<6>& recipe) {
    Bytes bytes(static_cast<std::size_t>(compiled_recipe_bytes(6)));
    const Result<std::ptrdiff_t> size =
        encode_recipe(recipe, {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())});
    require(size.ok());
    bytes.resize(static_cast<std::size_t>(*size));
    return bytes;
}

void read(const Bytes& bytes) {
    static RecipeOf<6> recipe;
    recipe = {};
    recipe.name[0] = 'k';
    const Status status = decode_recipe({bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())}, recipe);
    if (status != Status::ok) {
        require(recipe.name[0] == 'k' && recipe.name[1] == '\0' && recipe.features.empty());
        return;
    }
    const Bytes again = written(recipe);
    static RecipeOf<6> back;
    require(decode_recipe({again.data(), static_cast<std::ptrdiff_t>(again.size())}, back) == Status::ok);
    require(written(back) == again);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read(Bytes(data, data + size));
    if (size > 2000) return 0;
    Bytes whole = {'F', 'V', 'R', 'C', 1, 0, 0};
    whole.insert(whole.end(), data, data + size);
    const std::size_t length = whole.size() + 4;
    whole[5] = static_cast<std::uint8_t>(length & 255);
    whole[6] = static_cast<std::uint8_t>(length >> 8);
    const std::uint32_t sum = crc32({whole.data(), static_cast<std::ptrdiff_t>(whole.size())});
    for (int i = 0; i < 4; ++i) whole.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
    read(whole);
    return 0;
}
