// SPDX-License-Identifier: MIT
//
// The readers of codes on simulated ports: texts that are hard to tell, and lists. All the rest is in
// tests/target/firmware_read.py.
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fovea/code/qr_encode.hpp>
#include <fovea/codec/packet.hpp>
#include <fovea/image/bit_view.hpp>
#include <fovea/simulated/byte_pipe.hpp>
#include <fovea/simulated/pins.hpp>
#include <fovea/simulated/watchdog.hpp>

#include <firmware_read/bar_job.hpp>
#include <firmware_read/qr_job.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Ports = apps::FirmwarePorts<simulated::BytePipe, simulated::Pin, simulated::Pin, simulated::Clock,
                                  simulated::Watchdog>;
using BarMemory = apps::BarMemory<400>;
using QrMemory = apps::QrMemory<120, 110, 6, 60>;

Span<const std::uint8_t> span_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), static_cast<std::ptrdiff_t>(text.size())};
}

template <class Job>
class Board {
public:
    template <class... Arguments>
    explicit Board(const std::optional<std::string>& list, Arguments&&... arguments)
        : list_(list), job_(arguments...) {
        if (list_)
            firmware_.start(span_of(*list_));
        else
            firmware_.start();
    }
    void send(apps::PacketKind kind, std::initializer_list<int> numbers = {}, const Bytes& rest = {}) {
        Bytes content = {static_cast<std::uint8_t>(kind)};
        for (const int number : numbers) {
            content.push_back(static_cast<std::uint8_t>(number & 255));
            content.push_back(static_cast<std::uint8_t>(number >> 8));
        }
        content.insert(content.end(), rest.begin(), rest.end());
        Bytes line(2000);
        const auto size = encode_packet({content.data(), static_cast<std::ptrdiff_t>(content.size())},
                                        {line.data(), static_cast<std::ptrdiff_t>(line.size())});
        ASSERT_TRUE(size.ok());
        serial_.arriving.insert(serial_.arriving.end(), line.begin(), line.begin() + *size);
    }
    /// Triggers; what is said of the frame.
    std::string read(ImageView<const Gray8> image) {
        send(apps::PacketKind::trigger);
        said();
        send(apps::PacketKind::frame, {image.width(), image.height()});
        for (int y = 0; y < image.height(); ++y)
            send(apps::PacketKind::line, {y}, Bytes(image.row(y), image.row(y) + image.width()));
        return said();
    }
    std::string said() {
        do firmware_.turn();
        while (!serial_.arriving.empty());
        const std::string text(serial_.sent.begin(), serial_.sent.end());
        serial_.sent.clear();
        return text;
    }
    void wait_us(std::int64_t time) { clock_.now += time; }
    bool is(bool ok_active, bool not_ok_active) {
        return *ok_.active() == ok_active && *not_ok_.active() == not_ok_active;
    }

private:
    std::optional<std::string> list_;
    simulated::BytePipe serial_;
    simulated::Pin trigger_, ok_, not_ok_;
    simulated::Clock clock_;
    simulated::Watchdog watchdog_{clock_, 3000000};
    Job job_;
    apps::FrameFirmware<Ports, Job> firmware_{Ports{serial_, trigger_, ok_, not_ok_, clock_, watchdog_}, job_,
                                              "bench"};
};

class BarBoard {
public:
    explicit BarBoard(const std::optional<std::string>& list = {})
        : memory_(std::make_unique<BarMemory>()), board_(list, *memory_, bar_symbologies()) {}
    Board<apps::BarJob<BarMemory>>* operator->() { return &board_; }

private:
    std::unique_ptr<BarMemory> memory_;
    Board<apps::BarJob<BarMemory>> board_;
};
class QrBoard {
public:
    explicit QrBoard(const std::optional<std::string>& list = {})
        : memory_(std::make_unique<QrMemory>()), board_(list, *memory_) {}
    Board<apps::QrJob<QrMemory>>* operator->() { return &board_; }

private:
    std::unique_ptr<QrMemory> memory_;
    Board<apps::QrJob<QrMemory>> board_;
};

std::vector<Gray8> bars(Symbology symbology, const std::string& text) {
    Random random(5);
    BarPicture picture({400, 40});
    BarScene scene;
    scene.module = 2;
    draw_bars(picture, bars_of(symbology, text), scene, random);
    return {picture.view().row(0), picture.view().row(0) + 400 * 40};
}
std::string read_bars(BarBoard& board, Symbology symbology, const std::string& text) {
    const std::vector<Gray8> pixels = bars(symbology, text);
    return board->read(ImageView<const Gray8>(pixels.data(), {400, 40}, 400));
}
std::string read_qr(QrBoard& board, const std::string& text, int eci = TextSegment::not_stated) {
    std::vector<BitWord> words(6 * 177);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(qr_encode_scratch(200)));
    QrEncodeOptions options;
    options.eci = eci;
    const Result<BitView<BitWord>> symbol =
        qr_encode(span_of(text), options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                  BitView<BitWord>(words.data(), {177, 177}, 6));
    EXPECT_TRUE(symbol.ok());
    const int side = 2 * symbol->width() + 16;
    std::vector<Gray8> pixels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 220);
    const ImageView<Gray8> image(pixels.data(), {side, side}, side);
    for (int y = 8; y < side - 8; ++y)
        for (int x = 8; x < side - 8; ++x)
            if ((*symbol)((x - 8) / 2, (y - 8) / 2)) image(x, y) = 30;
    return board->read(image);
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FirmwareRead, SaysWhatItIs) {
    BarBoard bar_board;
    EXPECT_EQ(bar_board->said(),
              "{\"board\":\"bench\",\"reads\":\"bars\",\"allowed\":null,\"line_bytes\":400}\n");
    QrBoard qr_board("one\ntwo");
    EXPECT_EQ(
        qr_board->said(),
        "{\"board\":\"bench\",\"reads\":\"qr\",\"largest_version\":6,\"allowed\":2,\"frame_bytes\":13200,"
        "\"line_bytes\":120}\n");
}

TEST(FirmwareRead, TellsACodeWithTheKeysOfTheTool) {
    BarBoard board;
    const std::string said = read_bars(board, Symbology::ean_13, "9780905705712");
    EXPECT_TRUE(
        has(said,
            ",\"codes\":[{\"symbology\":\"EAN-13\",\"text\":\"9780905705712\",\"aim\":\"]E0\",\"corners_"
            "px\":[["))
        << said;
    EXPECT_TRUE(has(said, ",\"inverted\":false,\"mirrored\":false}],\"verdict\":\"ok\"}\n")) << said;
    EXPECT_TRUE(board->is(true, false));
    board->send(apps::PacketKind::trigger);
    board->said();
    EXPECT_TRUE(board->is(false, false));
}

TEST(FirmwareRead, TellsBytesThatDisturbALineOtherwise) {
    BarBoard board;
    EXPECT_TRUE(
        has(read_bars(board, Symbology::code_128, "a\"\\\n\x7f"), "\"text\":\"a\\\"\\\\\\u000a\\u007f\""));
}

TEST(FirmwareRead, TellsTextsInUtf8AndWhyOneIsNone) {
    QrBoard board;
    const std::string umlaut = read_qr(board,
                                       "stra\xdf"
                                       "e",
                                       3);
    EXPECT_TRUE(has(umlaut,
                    "\"text\":\"stra\xc3\x9f"
                    "e\""))
        << umlaut;
    EXPECT_TRUE(has(umlaut, ",\"grade\":{\"overall\":\"A\",")) << umlaut;
    const std::string unknown = read_qr(board, "abc", 999);
    EXPECT_TRUE(has(unknown, "\"text\":null,\"reason\":\"")) << unknown;
    EXPECT_TRUE(board->is(true, false));
}

TEST(FirmwareRead, ATextWithoutRoomIsNotJudged) {
    QrBoard board;
    EXPECT_TRUE(has(read_qr(board, std::string(61, 'a')), "\"verdict\":\"unmeasured\""));
    EXPECT_TRUE(board->is(false, false));
    EXPECT_TRUE(has(read_qr(board, std::string(60, 'a')), "\"verdict\":\"ok\""));
}

TEST(FirmwareRead, OnlyTextsOfTheListAreOk) {
    QrBoard board(
        "\r\nfirst\r\n\nstra\xc3\x9f"
        "e\nlast");
    for (const char* text : {"first", "last"}) {
        EXPECT_TRUE(has(read_qr(board, text), ",\"verdict\":\"ok\"}],\"verdict\":\"ok\"}")) << text;
        EXPECT_TRUE(board->is(true, false));
    }
    EXPECT_TRUE(has(read_qr(board,
                            "stra\xdf"
                            "e",
                            3),
                    "\"verdict\":\"ok\"}\n"));
    for (const char* text : {"firs", "first\r", "irst", "stra", "\r"}) {
        EXPECT_TRUE(has(read_qr(board, text), ",\"verdict\":\"not_ok\"}],\"verdict\":\"not_ok\"}")) << text;
        EXPECT_TRUE(board->is(false, true));
    }
    // What is no text is none of the list.
    EXPECT_TRUE(has(read_qr(board, "first", 999), "\"verdict\":\"not_ok\"}\n"));
}

TEST(FirmwareRead, WithAListWithoutTextsNothingIsRead) {
    for (const char* list : {"\r\n\n", ""}) {
        BarBoard board(list);
        EXPECT_TRUE(has(board->said(), "{\"error\":\"list refused: no text stands in it\"}\n"));
        board->send(apps::PacketKind::trigger);
        EXPECT_TRUE(has(board->said(), "\"error\":\"no allowed text\",\"verdict\":\"unmeasured\""));
        EXPECT_FALSE(has(read_bars(board, Symbology::ean_13, "9780905705712"), "codes"));
        EXPECT_TRUE(board->is(false, false));
    }
}

TEST(FirmwareRead, ALineMayBeWaitedFor) {
    BarBoard board;
    board->said();
    const std::vector<Gray8> pixels = bars(Symbology::ean_13, "9780905705712");
    board->send(apps::PacketKind::trigger);
    board->send(apps::PacketKind::frame, {400, 40});
    board->said();
    for (int y = 0; y < 40; ++y) {
        board->send(apps::PacketKind::line, {y},
                    Bytes(pixels.data() + 400 * y, pixels.data() + 400 * y + 400));
        board->send(apps::PacketKind::state);
        EXPECT_EQ(has(board->said(), "9780905705712"), y == 39);
    }
    EXPECT_TRUE(board->is(true, false));
}

TEST(FirmwareRead, TakesFramesThatHaveRoom) {
    QrBoard qr_board;
    const auto answer = [](auto& board, int width, int height) {
        board->send(apps::PacketKind::trigger);
        board->said();
        board->send(apps::PacketKind::frame, {width, height});
        return board->said();
    };
    EXPECT_EQ(answer(qr_board, 120, 110), "");
    qr_board->send(apps::PacketKind::line, {1});  // ends it
    qr_board->said();
    EXPECT_TRUE(has(answer(qr_board, 120, 111), "frame too large"));
    EXPECT_TRUE(has(answer(qr_board, 121, 10), "frame too large"));
    // As many pixels, but more words of bits.
    EXPECT_TRUE(has(answer(qr_board, 33, 400), "frame too large"));
    EXPECT_EQ(answer(qr_board, 1, 1), "");
    BarBoard bar_board;
    EXPECT_TRUE(has(answer(bar_board, 401, 1), "frame too large"));
    EXPECT_TRUE(has(answer(bar_board, 400, max_image_side + 1), "frame too large"));
    EXPECT_TRUE(has(answer(bar_board, 31, 9), "frame too narrow"));
    EXPECT_EQ(answer(bar_board, 32, 9), "");
    bar_board->send(apps::PacketKind::line, {0}, Bytes(32, 9));
    EXPECT_EQ(bar_board->said(), "");
    bar_board->send(apps::PacketKind::line, {1}, Bytes(33, 9));
    EXPECT_TRUE(has(bar_board->said(), "packet too long"));
}

TEST(FirmwareRead, LinesWithoutRoomAreToldOfOnce) {
    BarBoard board;
    board->said();
    const auto send_lines = [&](int count, std::size_t width) {
        for (int y = 0; y < count; ++y) board->send(apps::PacketKind::line, {y}, Bytes(width, 9));
    };
    const std::string too_long = "\"error\":\"packet too long\"";
    // Without a frame.
    send_lines(3, 401);
    EXPECT_EQ(board->said(), "{" + too_long + ",\"verdict\":\"unmeasured\"}\n");
    // Of a frame that was refused.
    board->send(apps::PacketKind::trigger);
    board->send(apps::PacketKind::frame, {401, 9});
    EXPECT_TRUE(has(board->said(), "frame too large"));
    send_lines(9, 401);
    EXPECT_EQ(board->said(), "");
    // Wider than their frame.
    board->send(apps::PacketKind::trigger);
    board->send(apps::PacketKind::frame, {32, 9});
    board->said();
    send_lines(9, 33);
    EXPECT_EQ(board->said(), "{\"frame\":2," + too_long + ",\"line\":0,\"verdict\":\"unmeasured\"}\n");
    // The last of them behind the next trigger, whose frame is taken.
    board->send(apps::PacketKind::trigger);
    EXPECT_EQ(board->said(), "{\"frame\":3,\"ready\":true}\n");
    send_lines(3, 33);
    board->send(apps::PacketKind::frame, {32, 2});
    send_lines(2, 32);
    EXPECT_TRUE(has(board->said(), "\"frame\":3,\"codes\":[]"));
    // What is none of the lines of a frame that has ended is told each time.
    send_lines(2, 401);
    EXPECT_EQ(board->said(), "{" + too_long + ",\"verdict\":\"unmeasured\"}\n");
    for (const auto kind : {apps::PacketKind::recipe, apps::PacketKind::frame, apps::PacketKind::state}) {
        for (int i = 0; i < 2; ++i) {
            board->send(kind, {}, Bytes(500, 9));
            EXPECT_EQ(board->said(), "{" + too_long + ",\"verdict\":\"unmeasured\"}\n");
        }
    }
}

// As those that have room do, they keep the next trigger waiting for its frame.
TEST(FirmwareRead, LinesWithoutRoomAreHeard) {
    for (const std::size_t width : {std::size_t{400}, std::size_t{401}}) {
        BarBoard board;
        board->said();
        board->send(apps::PacketKind::frame, {400, 9});
        EXPECT_TRUE(has(board->said(), "frame without a trigger"));
        board->send(apps::PacketKind::trigger);
        board->said();
        for (int y = 0; y < 3; ++y) {
            board->wait_us(1500000);
            board->send(apps::PacketKind::line, {y}, Bytes(width, 9));
            EXPECT_EQ(board->said(), "") << width;
        }
        board->wait_us(2500000);
        EXPECT_TRUE(has(board->said(), "no frame came")) << width;
    }
}

}  // namespace
}  // namespace fovea::test
