// SPDX-License-Identifier: MIT
//
// What every operator of the catalogue must keep, whatever it computes.
#include <gtest/gtest.h>

#include <ostream>
#include <set>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/catalogue/operator.hpp>
#include <op/all_operators.hpp>
#include <support/guarded_image.hpp>
#include <support/operator_run.hpp>

namespace fovea {
void PrintTo(const Operator* op, std::ostream* out) { *out << op->name; }
}  // namespace fovea

namespace fovea::test {
namespace {

std::vector<const Operator*> all_operators() {
    std::vector<const Operator*> all;
    for (const OperatorFamily& family : apps::all_operators())
        for (const Operator& op : family.operators) all.push_back(&op);
    return all;
}

/// The presets, every end of every parameter, and some random values.
std::vector<std::vector<int>> settings(const Operator& op) {
    std::vector<std::vector<int>> all = {OperatorRun::presets(op)};
    Random random(5);
    for (int i = 0; i < op.parameter_count(); ++i) {
        const OperatorParameter& parameter = op.parameters[i];
        const int steps = (parameter.most - parameter.least) / parameter.step;
        for (const int value : {parameter.least, parameter.least + steps * parameter.step,
                                parameter.least + random.between(0, steps) * parameter.step}) {
            all.push_back(OperatorRun::presets(op));
            all.back()[static_cast<std::size_t>(i)] = value;
        }
    }
    return all;
}

/// An operator may refuse a combination of values that are allowed one by one, and images as its entry says.
bool may_refuse(const Operator& op, Status status) {
    return status == Status::bad_argument || (status != Status::ok && status == op.refuses);
}

class CatalogueOperator : public testing::TestWithParam<const Operator*> {};

TEST_P(CatalogueOperator, DependsOnNeitherStrideNorScratchAndStaysInItsImages) {
    const Operator& op = *GetParam();
    std::vector<Size> sizes = test_sizes();
    sizes.push_back({3, 67});
    int done = 0;
    for (const std::vector<int>& values : settings(op))
        for (const Size size : sizes) {
            OperatorRun first(op, size, values);
            if (first.call.output.size.empty()) {
                EXPECT_EQ(first.run(), Status::bad_argument);
                continue;
            }
            if (first.call.output.size.area() > 4 << 20) continue;
            OperatorRun second(op, size, values, 0);
            first.fill(3, size.width > 20 ? 5 : 1);
            second.fill(3, size.width > 20 ? 5 : 1);
            second.dirty_scratch(0xee);
            const Status status = first.run();
            ASSERT_EQ(second.run(), status);
            ASSERT_TRUE(first.intact()) << size.width << "x" << size.height;
            if (status != Status::ok) {
                ASSERT_TRUE(may_refuse(op, status))
                    << describe(status) << " at " << size.width << "x" << size.height;
                ASSERT_TRUE(first.output().untouched());
                continue;
            }
            ASSERT_TRUE(first.output().same_pixels(second.output())) << size.width << "x" << size.height;
            ++done;
        }
    EXPECT_GT(done, 10);
}

TEST_P(CatalogueOperator, GivesTheSameInPlace) {
    const Operator& op = *GetParam();
    if (!op.in_place) return;
    ASSERT_EQ(op.output, op.inputs[0]);
    for (const Size size : test_sizes()) {
        OperatorRun apart(op, size, OperatorRun::presets(op)), together(op, size, OperatorRun::presets(op));
        apart.fill(8);
        together.fill(8);
        together.call.output = together.call.inputs[0];
        const Status status = apart.run();
        ASSERT_EQ(together.run(), status);
        if (status != Status::ok) {
            ASSERT_EQ(status, op.refuses);
            ASSERT_TRUE(together.intact());
            continue;
        }
        ASSERT_TRUE(apart.output().same_pixels(together.input(0))) << size.width << "x" << size.height;
        ASSERT_TRUE(together.intact());
    }
}

TEST_P(CatalogueOperator, SaysWhatIsWrongItselfAndLeavesTheOutput) {
    const Operator& op = *GetParam();
    const std::vector<int> values = OperatorRun::presets(op);
    const Size size{32, 24};
    {
        OperatorRun run(op, size, values);
        run.fill(1);
        run.call.inputs[0].size = {0, 24};
        EXPECT_EQ(run.run_unchecked(), Status::empty_image);
        run.call.inputs[0] = {};
        EXPECT_EQ(run.run_unchecked(), Status::empty_image);
        EXPECT_TRUE(run.output().untouched());
    }
    {
        OperatorRun run(op, size, values);
        run.fill(1);
        run.call.output.size.width -= 1;
        EXPECT_EQ(run.run(), Status::size_mismatch);
        if (op.output_size == nullptr) {
            EXPECT_EQ(run.run_unchecked(), Status::size_mismatch);
        }
        EXPECT_TRUE(run.output().untouched());
    }
    if (op.input_count() == 2) {
        OperatorRun run(op, size, values);
        run.call.inputs[1].size.height -= 1;
        EXPECT_EQ(run.run_unchecked(), Status::size_mismatch);
        EXPECT_TRUE(run.output().untouched());
    }
    if (op.scratch_for(size, OperatorRun(op, size, values).call.values) > 0) {
        OperatorRun run(op, size, values);
        run.fill(1);
        run.call.scratch = run.call.scratch.first(run.call.scratch.size() - 1);
        EXPECT_EQ(run.run_unchecked(), Status::scratch_too_small);
        EXPECT_TRUE(run.output().untouched());
    }
    for (int i = 0; i < op.parameter_count(); ++i) {
        const OperatorParameter& parameter = op.parameters[i];
        EXPECT_TRUE(parameter.allows(parameter.preset)) << parameter.name;
        for (const int wrong :
             {parameter.least - 1, parameter.most + 1, parameter.least + parameter.step / 2}) {
            if (parameter.allows(wrong)) continue;
            OperatorRun run(op, size, values);
            run.fill(1);
            run.call.values[i] = wrong;
            EXPECT_EQ(run.run(), Status::bad_argument) << parameter.name << " " << wrong;
            // A grey level or a choice cannot be wrong but by its type.
            const bool typed =
                parameter.choices != nullptr || (parameter.least == 0 && parameter.most == 255);
            if (!typed) {
                EXPECT_EQ(run.run_unchecked(), Status::bad_argument) << parameter.name << " " << wrong;
            }
            EXPECT_TRUE(run.output().untouched());
        }
    }
}

TEST_P(CatalogueOperator, TakesTheLongestRowAndRefusesALongerOne) {
    const Operator& op = *GetParam();
    const std::vector<int> values = OperatorRun::presets(op);
    for (const Size size : {Size{max_image_side, 1}, Size{1, max_image_side}}) {
        OperatorRun run(op, size, values);
        run.fill(2, 7);
        const Status status = run.run();
        EXPECT_TRUE(status == Status::ok || status == Status::image_too_large || may_refuse(op, status))
            << describe(status);
        EXPECT_TRUE(run.intact());
    }
    for (const Size size : {Size{65535, 1}, Size{1, 65535}}) {
        OperatorRun run(op, size, values);
        EXPECT_EQ(run.run(), Status::image_too_large);
        EXPECT_TRUE(run.output().untouched());
    }
}

TEST(Catalogue, NamesWhatAnOperatorRefuses) {
    // An entry that says so has an image that it refuses: one of a single level.
    int refusing = 0;
    for (const Operator* op : all_operators()) {
        if (op->refuses == Status::ok) continue;
        OperatorRun run(*op, {9, 5}, OperatorRun::presets(*op));
        EXPECT_EQ(run.run(), op->refuses) << op->name;
        EXPECT_TRUE(run.output().untouched());
        ++refusing;
    }
    EXPECT_GT(refusing, 0);
}

INSTANTIATE_TEST_SUITE_P(, CatalogueOperator, testing::ValuesIn(all_operators()),
                         [](const auto& parameter) { return std::string(parameter.param->name); });

TEST(Catalogue, HasUniqueNamesThatAreFound) {
    std::set<std::string> names;
    for (const Operator* op : all_operators()) {
        EXPECT_TRUE(names.insert(op->name).second) << op->name;
        EXPECT_EQ(find_operator(apps::all_operators(), op->name), op);
        if (op->alias == nullptr) continue;
        EXPECT_TRUE(names.insert(op->alias).second) << op->alias;
        EXPECT_EQ(find_operator(apps::all_operators(), op->alias), op);
    }
    EXPECT_EQ(find_operator(apps::all_operators(), "erod"), nullptr);
    EXPECT_EQ(find_operator(apps::all_operators(), "erodes"), nullptr);
    EXPECT_EQ(find_operator(apps::all_operators(), ""), nullptr);
}

TEST(Catalogue, HasAChoiceForEveryValueOfOne) {
    for (const Operator* op : all_operators())
        for (int i = 0; i < op->parameter_count(); ++i) {
            const OperatorParameter& parameter = op->parameters[i];
            EXPECT_GT(parameter.step, 0);
            if (parameter.choices == nullptr) continue;
            int count = 1;
            for (const char* c = parameter.choices; *c != '\0'; ++c) count += *c == '|' ? 1 : 0;
            EXPECT_EQ(parameter.least, 0) << op->name;
            EXPECT_EQ(parameter.most, count - 1) << op->name;
        }
}

}  // namespace
}  // namespace fovea::test
