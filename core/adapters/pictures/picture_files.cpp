#include "core/adapters/pictures/picture_files.h"

#include <fmt/format.h>
#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <variant>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/camera/pinhole_camera.h"

namespace glovebench {
namespace {

/// As stored; gray of 16 bits keeps its values.
using Picture = std::variant<ColorImage, Image<uint8_t>, Image<uint16_t>>;

const uint8_t* bytes_of(std::string_view content) { return reinterpret_cast<const uint8_t*>(content.data()); }

[[noreturn]] void refuse(const std::string& path, std::string_view found, const char* format) {
  throw Error(path, "content", printable(found), fmt::format("a whole {} image", format));
}

/// Before any memory is taken: the header of a small file may claim any size.
void require_size(int64_t width, int64_t height, const std::string& path) {
  if (width < 1 || height < 1 || width > kMostPixels || height > kMostPixels || width * height > kMostPixels)
    throw Error(path, "size", fmt::format("{}x{}", width, height), fmt::format("at most {} pixels", kMostPixels));
}

/// libpng's image, freed also where reading fails.
struct Png : png_image {
  Png() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~Png() { png_image_free(this); }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
};

template <typename Pixel>
Picture finish_png(Png& png, uint32_t format, const std::string& path) {
  png.format = format;
  Image<Pixel> image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (!png_image_finish_read(&png, nullptr, image.data(), 0, nullptr)) refuse(path, png.message, "PNG");
  return image;
}

Picture decode_png(std::string_view content, const std::string& path) {
  Png png;
  if (!png_image_begin_read_from_memory(&png, content.data(), content.size())) refuse(path, png.message, "PNG");
  require_size(png.width, png.height, path);
  if ((png.format & PNG_FORMAT_FLAG_COLOR) != 0) {
    png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
    return finish_png<Rgb>(png, PNG_FORMAT_RGB, path);
  }
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0) return finish_png<uint16_t>(png, PNG_FORMAT_LINEAR_Y, path);
  return finish_png<uint8_t>(png, PNG_FORMAT_GRAY, path);
}

using Jpeg = std::unique_ptr<void, decltype(&tjDestroy)>;

template <typename Pixel>
Picture finish_jpeg(const Jpeg& jpeg, std::string_view content, int width, int height, TJPF format,
                    const std::string& path) {
  Image<Pixel> image(width, height);
  if (tjDecompress2(jpeg.get(), bytes_of(content), content.size(), reinterpret_cast<uint8_t*>(image.data()), width,
                    0, height, format, TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS) != 0)
    refuse(path, tjGetErrorStr2(jpeg.get()), "JPEG");
  return image;
}

Picture decode_jpeg(std::string_view content, const std::string& path) {
  const Jpeg jpeg(tjInitDecompress(), &tjDestroy);
  int width = 0, height = 0, sampling = 0, colors = 0;
  if (tjDecompressHeader3(jpeg.get(), bytes_of(content), content.size(), &width, &height, &sampling, &colors) != 0)
    refuse(path, tjGetErrorStr2(jpeg.get()), "JPEG");
  if (width < 1 || height < 1) refuse(path, "no header", "JPEG");
  require_size(width, height, path);
  if (colors == TJCS_GRAY) return finish_jpeg<uint8_t>(jpeg, content, width, height, TJPF_GRAY, path);
  return finish_jpeg<Rgb>(jpeg, content, width, height, TJPF_RGB, path);
}

/// The next number of a Netpbm header, behind white space and comments. -1: none.
int64_t next_number(std::string_view& rest) {
  while (!rest.empty() &&
         (std::string_view(" \t\r\n").find(rest.front()) != std::string_view::npos || rest.front() == '#'))
    rest.remove_prefix(rest.front() == '#' ? std::min(rest.find('\n'), rest.size() - 1) + 1 : 1);
  int64_t number = -1;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  rest.remove_prefix(end - rest.data());
  return number;
}

template <typename Pixel>
Picture pixels(std::string_view bytes, int width, int height) {
  Image<Pixel> image(width, height);
  std::memcpy(image.data(), bytes.data(), image.size() * sizeof(Pixel));
  return image;
}

Picture decode_netpbm(std::string_view content, const std::string& path) {
  const bool is_color = content[1] == '6';
  std::string_view rest = content.substr(2);
  const int64_t width = next_number(rest), height = next_number(rest), most = next_number(rest);
  const char* const format = is_color ? "PPM" : "PGM";
  if (width < 0 || height < 0 || most < 1 || most > 65535 || rest.empty()) refuse(path, "no header", format);
  require_size(width, height, path);
  if (is_color && most > 255) refuse(path, fmt::format("values up to {}", most), "PPM (8 bits)");
  rest.remove_prefix(1);
  const size_t expected = width * height * (is_color ? 3 : most > 255 ? 2 : 1);
  if (rest.size() < expected) refuse(path, fmt::format("{} of {} bytes", rest.size(), expected), format);
  const int columns = static_cast<int>(width), rows = static_cast<int>(height);
  if (is_color) return pixels<Rgb>(rest, columns, rows);
  if (most <= 255) return pixels<uint8_t>(rest, columns, rows);
  Image<uint16_t> deep(columns, rows);
  for (size_t i = 0; i < deep.size(); ++i)  // big-endian
    deep[i] = static_cast<uint16_t>(bytes_of(rest)[2 * i] << 8 | bytes_of(rest)[2 * i + 1]);
  return deep;
}

Picture decode(std::string_view content, const std::string& path) {
  if (content.starts_with("\x89PNG")) return decode_png(content, path);
  if (content.starts_with("\xff\xd8")) return decode_jpeg(content, path);
  if (content.starts_with("P5") || content.starts_with("P6")) return decode_netpbm(content, path);
  throw Error(path, "content", "no image", "a PNG, JPEG, PGM or PPM file");
}

/// Leaves out the chunks by which libpng would change values (gAMA, sRGB, iCCP).
std::string without_ancillary_chunks(std::string_view png) {
  constexpr size_t kMagic = 8, kFrame = 12;  // bytes; length, type and CRC
  std::string kept(png.substr(0, kMagic));
  for (png.remove_prefix(kept.size()); png.size() >= kFrame;) {
    const uint8_t* const length = bytes_of(png);
    const size_t size =
        kFrame + (static_cast<size_t>(length[0]) << 24 | length[1] << 16 | length[2] << 8 | length[3]);
    const bool is_ancillary = (png[4] & 0x20) != 0;
    if (!is_ancillary) kept += png.substr(0, size);
    png.remove_prefix(std::min(size, png.size()));
  }
  return kept;
}

template <typename Pixel>
std::string png_of(const Image<Pixel>& image, uint32_t format) {
  Png png;
  png.width = image.width();
  png.height = image.height();
  png.format = format;
  png.flags = PNG_IMAGE_FLAG_FAST;  // a video has many: more bytes in less time
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  check(png_image_write_to_memory(&png, bytes.data(), &size, 0, image.data(), 0, nullptr) != 0, "an image encodes");
  bytes.resize(size);
  return bytes;
}

Image<uint8_t> stretched(const Image<uint16_t>& deep) {
  const auto [low, high] = std::ranges::minmax(deep);
  Image<uint8_t> gray(deep.width(), deep.height());
  if (high == low) return gray;
  for (size_t i = 0; i < deep.size(); ++i)
    gray[i] = static_cast<uint8_t>(std::lround(255.0 * (deep[i] - low) / (high - low)));
  return gray;
}

}  // namespace

std::string encode_png(const ColorImage& image) { return png_of(image, PNG_FORMAT_RGB); }

std::string encode_png(const Image<uint8_t>& image) { return png_of(image, PNG_FORMAT_GRAY); }

std::string encode_png(const Image<uint16_t>& image) { return png_of(image, PNG_FORMAT_LINEAR_Y); }

std::string encode_jpeg(const ColorImage& image, int quality) {
  const Jpeg jpeg(tjInitCompress(), &tjDestroy);
  unsigned long size = tjBufSize(image.width(), image.height(), TJSAMP_420);
  std::string bytes(size, '\0');
  auto* to = reinterpret_cast<uint8_t*>(bytes.data());
  check(tjCompress2(jpeg.get(), reinterpret_cast<const uint8_t*>(image.data()), image.width(), 0, image.height(),
                    TJPF_RGB, &to, &size, TJSAMP_420, quality, TJFLAG_NOREALLOC) == 0,
        "an image encodes");
  bytes.resize(size);
  return bytes;
}

ColorImage decode_color(std::string_view content, const std::string& path) {
  Picture picture = decode(content, path);
  if (auto* color = std::get_if<ColorImage>(&picture)) return std::move(*color);
  const auto* deep = std::get_if<Image<uint16_t>>(&picture);
  const Image<uint8_t> gray = deep != nullptr ? stretched(*deep) : std::get<Image<uint8_t>>(picture);
  ColorImage color(gray.width(), gray.height());
  std::ranges::transform(gray, color.begin(), [](uint8_t value) { return Rgb{value, value, value}; });
  return color;
}

Image<uint16_t> decode_deep(std::string_view content, const std::string& path) {
  const bool is_png = content.starts_with("\x89PNG");
  Picture picture = decode(is_png ? without_ancillary_chunks(content) : content, path);
  if (auto* deep = std::get_if<Image<uint16_t>>(&picture)) return std::move(*deep);
  throw Error(path, "pixels", "color or 8 bits", "gray of 16 bits");
}

Image<uint8_t> decode_gray(std::string_view content, const std::string& path) {
  Picture picture = decode(content, path);
  if (auto* gray = std::get_if<Image<uint8_t>>(&picture)) return std::move(*gray);
  if (const auto* deep = std::get_if<Image<uint16_t>>(&picture)) return stretched(*deep);
  const auto& color = std::get<ColorImage>(picture);
  Image<uint8_t> gray(color.width(), color.height());
  std::ranges::transform(color, gray.begin(), [](const Rgb& rgb) {
    return static_cast<uint8_t>((299 * rgb[0] + 587 * rgb[1] + 114 * rgb[2] + 500) / 1000);
  });
  return gray;
}

}  // namespace glovebench
