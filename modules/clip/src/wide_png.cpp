// SPDX-License-Identifier: MIT
#include "wide_png.hpp"

#include "placed.hpp"

#include <goffer/io/bytes.hpp>

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstdio>
#include <string>

namespace goffer::clip {

/// libpng's state, with the way out of its errors: C code lies between, which an exception must not cross.
/// Functions that jump, or are jumped over, have no objects with destructors.
struct WidePng::Encoder {
    png_structp png = nullptr;
    png_infop info = nullptr;
    char message[128] = "";
    std::string bytes;  ///< of a row

    Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
    ~Encoder() { png_destroy_write_struct(&png, &info); }

    /// Return false where they fail, with the message.
    bool begin(std::FILE* stream, std::size_t width, std::size_t height);
    bool write_row(const char* row);
    bool end();
};

namespace {

[[noreturn]] void leave(png_structp png, const char* text) {
    char* const message = static_cast<char*>(png_get_error_ptr(png));
    std::snprintf(message, 128, "%s", text);
    png_longjmp(png, 1);
}

void take_warning(png_structp, const char*) {}

}  // namespace

WidePng::Encoder::Encoder() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, message, leave, take_warning);
    if (png) info = png_create_info_struct(png);
}

bool WidePng::Encoder::begin(std::FILE* stream, std::size_t width, std::size_t height) {
    if (!png || !info) return false;
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_init_io(png, stream);
    // As small as at the usual level, 6, in three quarters of the time: the low bytes are noise.
    png_set_compression_level(png, 4);
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 16,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    return true;
}

bool WidePng::Encoder::write_row(const char* row) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_write_row(png, reinterpret_cast<png_const_bytep>(row));
    return true;
}

bool WidePng::Encoder::end() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_write_end(png, info);
    return true;
}

WidePng::WidePng(std::size_t width, std::size_t height, io::AtomicFile& out,
                 const std::filesystem::path& file)
    : encoder_(std::make_unique<Encoder>()), out_(out), file_(file) {
    check(encoder_->begin(out_.stream(), width, height));
}

WidePng::~WidePng() = default;

void WidePng::check(bool good) {
    if (good) return;
    out_.flush();  // says it better where it is the disk's fault
    fail(file_, std::string("cannot be packed as PNG: ") + encoder_->message +
                    "; check the folder's free space, or use a smaller mesh");
}

void WidePng::write_row(std::span<const std::uint16_t> rgb) {
    encoder_->bytes.clear();
    for (const std::uint16_t channel : rgb) io::append_bytes(encoder_->bytes, std::endian::big, channel);
    check(encoder_->write_row(encoder_->bytes.data()));
}

void WidePng::finish() {
    check(encoder_->end());
}

}  // namespace goffer::clip
