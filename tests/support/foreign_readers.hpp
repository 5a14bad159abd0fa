// SPDX-License-Identifier: MIT
//
// Readers of codes that others have written, as far as they are installed: zxing-cpp, zbar and libdmtx of
// Debian. Host programs only; foreign_readers.cmake says which there are.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#ifdef FOVEA_HAVE_ZBAR
#include <zbar.h>
#endif

#include <common/picture_file.hpp>

#ifdef FOVEA_HAVE_ZXING
#include <ZXing/ReadBarcode.h>
#include <ZXing/TextUtfEncoding.h>
#endif
#ifdef FOVEA_HAVE_DMTX
#include <dmtx.h>
#endif

namespace fovea::test {

/// The texts that a reader finds in a picture.
using Texts = std::vector<std::string>;
struct CodeReader {
    const char* name;
    std::function<Texts(const apps::Picture<Gray8>&)> read;
};

#ifdef FOVEA_HAVE_ZXING
namespace detail {

inline ZXing::DecodeHints zxing_hints() {
    ZXing::DecodeHints hints;
    hints.setTryHarder(true);
    hints.setTryRotate(true);
    return hints;
}
inline ZXing::ImageView zxing_view(const apps::Picture<Gray8>& picture) {
    return {picture.pixels.data(), picture.size.width, picture.size.height, ZXing::ImageFormat::Lum};
}

}  // namespace detail

/// zxing-cpp with all symbologies, in the thorough way, up to its first code.
inline Texts read_one_with_zxing(const apps::Picture<Gray8>& picture) {
    const auto found = ZXing::ReadBarcode(detail::zxing_view(picture), detail::zxing_hints());
    return found.isValid() ? Texts{ZXing::TextUtfEncoding::ToUtf8(found.text())} : Texts{};
}
inline Texts read_with_zxing(const apps::Picture<Gray8>& picture) {
    Texts texts;
    for (const auto& found : ZXing::ReadBarcodes(detail::zxing_view(picture), detail::zxing_hints()))
        texts.push_back(ZXing::TextUtfEncoding::ToUtf8(found.text()));
    return texts;
}
#endif

#ifdef FOVEA_HAVE_ZBAR
/// zbar with all symbologies, UPC-A and UPC-E told as such.
inline CodeReader zbar_reader(const char* name) {
    const auto scanner = std::make_shared<zbar::ImageScanner>();
    scanner->set_config(zbar::ZBAR_NONE, zbar::ZBAR_CFG_ENABLE, 1);
    scanner->set_config(zbar::ZBAR_UPCA, zbar::ZBAR_CFG_ENABLE, 1);
    scanner->set_config(zbar::ZBAR_UPCE, zbar::ZBAR_CFG_ENABLE, 1);
    return {name, [scanner](const apps::Picture<Gray8>& picture) {
                zbar::Image image(static_cast<unsigned>(picture.size.width),
                                  static_cast<unsigned>(picture.size.height), "Y800", picture.pixels.data(),
                                  picture.pixels.size());
                scanner->scan(image);
                Texts texts;
                for (auto symbol = image.symbol_begin(); symbol != image.symbol_end(); ++symbol)
                    texts.push_back(symbol->get_data());
                return texts;
            }};
}
#endif

#ifdef FOVEA_HAVE_DMTX
/// libdmtx up to its first Data Matrix. It has no end of its own on pictures without one: patience ends it.
inline Texts read_with_dmtx(const apps::Picture<Gray8>& picture, long patience_ms) {
    std::vector<unsigned char> pixels(picture.pixels.begin(), picture.pixels.end());
    DmtxImage* image = dmtxImageCreate(pixels.data(), picture.size.width, picture.size.height, DmtxPack8bppK);
    DmtxDecode* decode = dmtxDecodeCreate(image, 1);
    DmtxTime end = dmtxTimeAdd(dmtxTimeNow(), patience_ms);
    Texts texts;
    while (texts.empty()) {
        DmtxRegion* region = dmtxRegionFindNext(decode, &end);
        if (region == nullptr) break;
        if (DmtxMessage* message = dmtxDecodeMatrixRegion(decode, region, DmtxUndefined)) {
            texts.emplace_back(message->output, message->output + message->outputIdx);
            dmtxMessageDestroy(&message);
        }
        dmtxRegionDestroy(&region);
    }
    dmtxDecodeDestroy(&decode);
    dmtxImageDestroy(&image);
    return texts;
}
#endif

}  // namespace fovea::test
