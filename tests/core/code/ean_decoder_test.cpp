// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fovea/code/bar_edges.hpp>
#include <fovea/code/ean_decoder.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

std::string digits(Random& random, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += static_cast<char>('0' + random.below(10));
    return text;
}
std::string read(const std::vector<std::int32_t>& edges, const BarRules& rules = {}) {
    BarReading reading;
    const Status status = decode_ean(span_of(edges), 1, rules, reading);
    return status == Status::ok ? std::string(name(reading.symbology)) + " " + text_of(reading)
                                : describe(status);
}

TEST(EanDecoder, ReadsTheBooksIsbn) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 512);
    BarReading reading;
    ASSERT_EQ(decode_ean(span_of(edges), 1, {}, reading), Status::ok);
    EXPECT_EQ(text_of(reading), "9780905705712");
    EXPECT_EQ(reading.symbology, Symbology::ean_13);
    EXPECT_EQ(reading.aim_digit, '0');
    EXPECT_EQ(reading.first, 1);
    EXPECT_EQ(reading.last, 60);
    EXPECT_EQ(reading.error, 0);
    EXPECT_EQ(reading.quiet, 256);
    EXPECT_EQ(reading.base, 13);
}

TEST(EanDecoder, ReadsWhatTheEncoderDraws) {
    Random random(3101);
    for (int round = 0; round < 500; ++round) {
        const int module = 200 + static_cast<int>(random.below(3000));
        const int gain = random.between(-module / 3, module / 3);
        struct {
            Symbology symbology;
            int count;
        } const kinds[] = {{Symbology::ean_13, 12}, {Symbology::ean_8, 7}, {Symbology::upc_a, 11}};
        for (const auto& kind : kinds) {
            std::string text = digits(random, kind.count);
            if (kind.symbology == Symbology::ean_13) text[0] = static_cast<char>('1' + random.below(9));
            const std::string got = read(edges_of(bars_of(kind.symbology, text), module, 12, gain));
            EXPECT_EQ(got.substr(0, got.size() - 1), std::string(name(kind.symbology)) + " " + text);
        }
        const std::string text = (round % 2 == 0 ? "0" : "1") + digits(random, 6);
        const std::string got = read(edges_of(bars_of(Symbology::upc_e, text), module, 12, gain));
        EXPECT_EQ(got.substr(0, got.size() - 1), "UPC-E " + text);
    }
}

/// Narrows the two bars of a digit of the left half by so much each, which keeps edges of the same kind where
/// they are to each other.
void narrow_bars(std::vector<std::int32_t>& edges, int digit, std::int32_t by) {
    const auto first = static_cast<std::size_t>(1 + 3 + 4 * digit);
    for (const std::size_t bar : {first + 1, first + 3}) {
        edges[bar] += by / 2;
        edges[bar + 1] -= by / 2;
    }
}

// Bars of 8 and 7 that have lost 40/64 module: one such digit is told by the check digit, and so are two
// beside each other. With a third, 2, 1 and 1 in their place change the sum by 3 * 6 + 6 + 6.
TEST(EanDecoder, TwinsThatTheCheckDigitDoesNotTellApartAreNotRead) {
    const std::vector<std::int32_t> sharp = edges_of(bars_of(Symbology::ean_13, "987878887878"), 512);
    const std::string right = read(sharp);
    ASSERT_EQ(right.substr(0, 19), "EAN-13 987878887878");
    std::vector<std::int32_t> edges = sharp;
    narrow_bars(edges, 0, 160);
    EXPECT_EQ(read(edges), right);
    narrow_bars(edges, 1, 160);
    EXPECT_EQ(read(edges), right);
    narrow_bars(edges, 3, 160);
    EXPECT_EQ(read(edges), "nothing found");
    edges = sharp;
    for (const int digit : {0, 1, 3}) narrow_bars(edges, digit, 120);
    EXPECT_EQ(read(edges), right);
}

// The last digit of a UPC-E says where its zeros are: with 2 in place of 8 the check digit may be the same.
TEST(EanDecoder, AUpcEWithADoubtfulTwinIsNotRead) {
    for (const bool doubtful : {false, true}) {
        std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::upc_e, "0791388"), 512);
        narrow_bars(edges, 5, doubtful ? 160 : 120);
        EXPECT_EQ(read(edges), doubtful ? "nothing found" : "UPC-E 07913884");
    }
}

// The left half of 4828599153336 and, of the first bar behind the middle guard, so much as a sheet over the
// rest lets see.
TEST(EanDecoder, TheLeftHalfOfAnEan13IsAUpcEOnlyWhereItEndsInANarrowBar) {
    for (const int seen : {256, 512, 768}) {
        std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "482859915333"), 512);
        edges.resize(1 + 33);
        edges.push_back(edges.back() + seen);
        edges.push_back(edges.back() + 20 * 512);
        EXPECT_EQ(read(edges), seen == 512 ? "UPC-E 18285994" : "nothing found") << seen;
    }
}

TEST(EanDecoder, FollowsAModuleThatGrowsAlongTheLine) {
    std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 512);
    for (std::int32_t& edge : edges) {
        edge = static_cast<std::int32_t>(edge + std::int64_t{edge} * edge / (edges.back() * std::int64_t{2}));
    }
    EXPECT_EQ(read(edges), "EAN-13 9780905705712");
}

TEST(EanDecoder, ReadsNothingFromTheWrongEnd) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 512);
    std::vector<std::int32_t> reversed(edges.size() + 1);
    reversed.resize(static_cast<std::size_t>(
        reverse_bar_edges(span_of(edges), {reversed.data(), static_cast<std::ptrdiff_t>(reversed.size())})));
    EXPECT_EQ(read(reversed), "nothing found");
    EXPECT_EQ(reversed.size(), edges.size());
}

TEST(EanDecoder, UpcAIsAnEan13WhereOnlyThatIsWanted) {
    BarRules rules;
    rules.symbologies = Symbology::ean_13;
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::upc_a, "023942431015"), 512);
    EXPECT_EQ(read(edges), "UPC-A 023942431015");
    EXPECT_EQ(read(edges, rules), "EAN-13 0023942431015");
    rules.symbologies = Symbology::upc_a;
    EXPECT_EQ(read(edges_of(bars_of(Symbology::ean_13, "9780905705712"), 512), rules), "nothing found");
}

TEST(EanDecoder, TellsHowPoorTheQuietZoneIsAndWantsSomeOfIt) {
    const Bars isbn = bars_of(Symbology::ean_13, "9780905705712");
    BarReading reading;
    const std::vector<std::int32_t> narrow = edges_of(isbn, 512, 5);
    ASSERT_EQ(decode_ean(span_of(narrow), 1, {}, reading), Status::ok);
    EXPECT_EQ(reading.quiet, 5 * 256 / 11);
    EXPECT_EQ(read(edges_of(isbn, 512, 2)), "nothing found");
    EXPECT_EQ(read(edges_of(bars_of(Symbology::upc_e, "01234565"), 512, 3)), "nothing found");
}

TEST(EanDecoder, TheLeftHalfOfAnEan13IsNoUpcE) {
    // Its parity is that of a UPC-E, and the check digit may fit: the space behind it must not be a quiet
    // zone.
    Random random(3102);
    BarRules rules;
    rules.symbologies = Symbology::upc_e;
    for (int round = 0; round < 2000; ++round) {
        const Bars bars = bars_of(Symbology::ean_13, "9" + digits(random, 11));
        EXPECT_EQ(read(edges_of(bars, 512), rules), "nothing found");
    }
}

TEST(EanDecoder, OneWrongDigitIsNoCode) {
    Random random(3103);
    for (int round = 0; round < 300; ++round) {
        Bars bars = bars_of(Symbology::ean_13, digits(random, 12));
        const Bars other = bars_of(Symbology::ean_13, digits(random, 12));
        const int at = 32 + 4 * static_cast<int>(random.below(6));  // on the right, where parity says nothing
        bool same = true;
        for (int i = at; i < at + 4; ++i) {
            same = same && bars.widths[i] == other.widths[i];
            bars.widths[i] = other.widths[i];
        }
        if (!same) {
            EXPECT_EQ(read(edges_of(bars, 512)), "nothing found");
        }
    }
}

TEST(EanDecoder, AppendsAnAddOnWhereItIsWanted) {
    BarRules rules;
    rules.add_on = AddOn::appended;
    for (const char* add_on : {"90", "07", "41", "52495", "90000"}) {
        Bars bars = bars_of(Symbology::ean_13, "9780905705712");
        bars.widths[bars.count++] = 9;
        ASSERT_EQ(encode_add_on(bytes_of(add_on), bars.view()), Status::ok);
        const std::vector<std::int32_t> edges = edges_of(bars, 512);
        BarReading reading;
        ASSERT_EQ(decode_ean(span_of(edges), 1, rules, reading), Status::ok);
        EXPECT_EQ(text_of(reading), std::string("9780905705712") + add_on);
        EXPECT_EQ(reading.base, 13);
        EXPECT_EQ(reading.aim_digit, '3');
        EXPECT_EQ(read(edges), "EAN-13 9780905705712");
    }
}

// A gain of a third of a module makes the two bars of a digit two thirds wider, and its twin has them two
// modules wider or narrower.
TEST(EanDecoder, ReadsAddOnsOfBarsThatAreTooWideOrTooNarrow) {
    Random random(3104);
    BarRules rules;
    rules.add_on = AddOn::appended;
    struct {
        Symbology symbology;
        int count;
    } const kinds[] = {{Symbology::ean_13, 12}, {Symbology::upc_a, 11}, {Symbology::upc_e, 7}};
    for (int round = 0; round < 500; ++round) {
        const int module = 200 + static_cast<int>(random.below(3000));
        const int gain = round % 2 == 0 ? random.between(-module / 3, module / 3)
                                        : (round % 4 == 1 ? module / 3 : -module / 3);
        for (const auto& kind : kinds) {
            std::string text = digits(random, kind.count);
            if (kind.symbology == Symbology::ean_13) text[0] = static_cast<char>('1' + random.below(9));
            if (kind.symbology == Symbology::upc_e) text[0] = static_cast<char>('0' + random.below(2));
            for (const int add_on_digits : {2, 5}) {
                const std::string add_on = digits(random, add_on_digits);
                Bars bars = bars_of(kind.symbology, text);
                bars.widths[bars.count++] = 9;
                ASSERT_EQ(encode_add_on(bytes_of(add_on), bars.view()), Status::ok);
                BarReading reading;
                const std::vector<std::int32_t> edges = edges_of(bars, module, 12, gain);
                ASSERT_EQ(decode_ean(span_of(edges), 1, rules, reading), Status::ok) << text;
                EXPECT_EQ(reading.symbology, kind.symbology);
                EXPECT_EQ(reading.base, static_cast<int>(text.size()) + 1);
                EXPECT_EQ(text_of(reading).substr(text.size() + 1), add_on) << text << ", gain " << gain;
                EXPECT_EQ(reading.aim_digit, '3');
            }
        }
    }
}

// A digit of an add-on whose bars lie between it and its twin, less the gain of its code, is not told.
TEST(EanDecoder, AnAddOnWithADoubtfulTwinIsNotAppended) {
    BarRules rules;
    rules.add_on = AddOn::appended;
    Bars bars = bars_of(Symbology::ean_13, "9780905705712");
    bars.widths[bars.count++] = 9;
    const int first = bars.count;
    ASSERT_EQ(encode_add_on(bytes_of("87"), bars.view()), Status::ok);
    for (const int gain : {-170, 0, 170}) {
        for (const bool doubtful : {false, true}) {
            std::vector<std::int32_t> edges = edges_of(bars, 512, 12, gain);
            for (const int bar : {1, 3}) {
                const auto at = static_cast<std::size_t>(1 + first + 3 + bar);
                edges[at] += doubtful ? 80 : 60;
                edges[at + 1] -= doubtful ? 80 : 60;
            }
            EXPECT_EQ(read(edges, rules), doubtful ? "EAN-13 9780905705712" : "EAN-13 978090570571287")
                << gain;
        }
    }
}

TEST(EanDecoder, LeavesTheReadingOnErrors) {
    const std::vector<std::int32_t> edges = edges_of(bars_of(Symbology::ean_13, "9780905705712"), 512);
    BarReading reading;
    reading.size = 77;
    EXPECT_EQ(decode_ean(span_of(edges), 2, {}, reading), Status::out_of_range);
    EXPECT_EQ(decode_ean(span_of(edges), -1, {}, reading), Status::out_of_range);
    EXPECT_EQ(decode_ean(span_of(edges), 63, {}, reading), Status::out_of_range);
    EXPECT_EQ(decode_ean(span_of(edges), 3, {}, reading), Status::not_found);
    EXPECT_EQ(decode_ean(span_of(edges).first(61), 1, {}, reading), Status::not_found);
    EXPECT_EQ(reading.size, 77);
}

}  // namespace
}  // namespace fovea::test
