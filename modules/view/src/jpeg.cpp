// SPDX-License-Identifier: MIT
#include "decode.hpp"

// clang-format off
#include <jpeglib.h>
#include <jerror.h>  // its numbers are those of the version that jpeglib.h says, which differs in Ubuntu
// clang-format on

#include <csetjmp>
#include <cstdio>  // jpeglib.h does without, and needs it
#include <string>

namespace goffer::view {
namespace {

/// A progressive JPEG may go through all of its pixels once more for every few bytes. Cameras and exporters
/// write ten scans or so.
constexpr int most_scans = 100;

/// libjpeg's state, with the way out of its errors: C code lies between, which an exception must not cross.
/// Functions that jump, or are jumped over, have no objects with destructors.
struct Decoder {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf way_out{};
    char message[JMSG_LENGTH_MAX] = "";

    Decoder();
    Decoder(const Decoder&) = delete;
    Decoder& operator=(const Decoder&) = delete;
    ~Decoder() { jpeg_destroy_decompress(&info); }

    /// Return false where they fail, with the message.
    bool read_header(std::string_view bytes);
    bool read_rows(unsigned char* rgba);
};

Decoder& decoder_of(j_common_ptr info) {
    return *static_cast<Decoder*>(info->client_data);
}

[[noreturn]] void leave(j_common_ptr info) {
    Decoder& decoder = decoder_of(info);
    decoder.errors.format_message(info, decoder.message);
    std::longjmp(decoder.way_out, 1);
}

/// Warnings pass, but for that of a file that is cut off: the rest would be gray.
void take_message(j_common_ptr info, int level) {
    if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF) leave(info);
}

void look_at_scans(j_common_ptr info) {
    Decoder& decoder = decoder_of(info);
    if (decoder.info.input_scan_number <= most_scans) return;
    std::snprintf(decoder.message, sizeof decoder.message, "it has more than %d scans", most_scans);
    std::longjmp(decoder.way_out, 1);
}

Decoder::Decoder() {
    info.err = jpeg_std_error(&errors);
    errors.error_exit = leave;
    errors.emit_message = take_message;
    errors.output_message = [](j_common_ptr) {};
    info.client_data = this;
}

bool Decoder::read_header(std::string_view bytes) {
    if (setjmp(way_out) != 0) return false;
    jpeg_create_decompress(&info);
    progress.progress_monitor = look_at_scans;
    info.progress = &progress;
    // Older versions take the bytes without const, and do not write them.
    jpeg_mem_src(&info, reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data())),
                 static_cast<unsigned long>(bytes.size()));
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_RGB;
    return true;
}

/// Each row is read into the end of its place, as RGB, and then spread out.
bool Decoder::read_rows(unsigned char* rgba) {
    if (setjmp(way_out) != 0) return false;
    jpeg_start_decompress(&info);
    const std::size_t width = info.output_width;
    while (info.output_scanline < info.output_height) {
        unsigned char* const out = rgba + 4 * width * info.output_scanline;
        unsigned char* in = out + width;
        jpeg_read_scanlines(&info, &in, 1);
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) out[4 * x + c] = in[3 * x + c];
            out[4 * x + 3] = 255;
        }
    }
    jpeg_finish_decompress(&info);
    return true;
}

}  // namespace

Image decode_jpeg(std::string_view bytes, std::uint64_t most_pixels) {
    Decoder decoder;
    const auto check = [&](bool good) {
        if (!good)
            throw Error(std::string("the JPEG is broken or of a rare kind: ") + decoder.message +
                        "; export it again, as RGB");
    };
    check(decoder.read_header(bytes));
    check_image_size(decoder.info.image_width, decoder.info.image_height, most_pixels);
    Image image{static_cast<int>(decoder.info.image_width), static_cast<int>(decoder.info.image_height), {}};
    image.rgba.resize(std::size_t{4} * decoder.info.image_width * decoder.info.image_height);
    check(decoder.read_rows(image.rgba.data()));
    return image;
}

}  // namespace goffer::view
