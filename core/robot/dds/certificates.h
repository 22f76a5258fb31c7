#pragma once

#include <cstdint>
#include <memory>
#include <string>

/// X.509 certificates and S/MIME signatures for DDS Security, by OpenSSL: EC P-256 keys, SHA-256, PEM texts.
namespace glovebench {

/// From when until when a certificate holds, seconds since 1970.
struct Validity {
  int64_t begin_s = 0;
  int64_t end_s = 0;
};

struct Identity {
  std::string certificate;  ///< PEM
  std::string private_key;  ///< PEM, without a password
};

/// Vouches for certificates and documents. Its private key lives as long as this object, and nowhere else.
class Authority {
 public:
  /// `name`: its common name. Throws Error if OpenSSL fails.
  Authority(const std::string& name, const Validity& validity);
  ~Authority();
  Authority(const Authority&) = delete;
  Authority& operator=(const Authority&) = delete;

  std::string certificate() const;
  /// A new key with a certificate for it. Throws Error.
  Identity issue(const std::string& name, const Validity& validity) const;
  /// The text as S/MIME, in the clear with a detached signature. Throws Error.
  std::string sign(const std::string& text) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// A text and the file that it comes from.
struct PemFile {
  std::string path;
  std::string text;
};

/// Throws Error naming the file unless it is a certificate that holds at `now_s`.
void check_certificate(const PemFile& certificate, int64_t now_s);
/// Throws Error unless the authority has issued the certificate, and the private key is the certificate's.
void check_identity(const PemFile& certificate, const PemFile& private_key, const PemFile& authority);
/// Throws Error unless the authority has signed the document.
void check_signature(const PemFile& document, const PemFile& authority);

}  // namespace glovebench
