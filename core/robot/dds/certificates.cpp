#include "core/robot/dds/certificates.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <ctime>

#include "core/base/error.h"

namespace glovebench {
namespace {

template <auto kFree>
struct Freed {
  template <typename T>
  void operator()(T* it) const {
    kFree(it);
  }
};
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Signature = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<X509_STORE_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>>;
using Number = std::unique_ptr<BIGNUM, Freed<BN_free>>;

constexpr int kSignatureFlags = PKCS7_DETACHED | PKCS7_TEXT;  // DDS Security wants a text/plain part
constexpr int kSerialBits = 127;

/// Throws Error unless `fine`.
void check_openssl(bool fine, const char* what) {
  if (fine) return;
  const char* const reason = ERR_reason_error_string(ERR_get_error());
  throw Error("OpenSSL", what, reason ? reason : "a failure", "a certificate or signature");
}

Bio reading(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

template <typename Write>
std::string written(const char* what, const Write& write) {
  const Bio bio(BIO_new(BIO_s_mem()));
  check_openssl(bio && write(bio.get()) == 1, what);
  char* begin = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &begin);
  return {begin, static_cast<size_t>(size)};
}

std::string pem(X509* certificate) {
  return written("certificate", [&](BIO* bio) { return PEM_write_bio_X509(bio, certificate); });
}

std::string pem(EVP_PKEY* key) {
  return written("private key", [&](BIO* bio) {
    return PEM_write_bio_PrivateKey(bio, key, nullptr, nullptr, 0, nullptr, nullptr);
  });
}

Key new_key() {
  Key key(EVP_EC_gen("P-256"));
  check_openssl(key != nullptr, "private key");
  return key;
}

void add_extension(X509* certificate, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const Extension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  check_openssl(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "extension");
}

/// Without an issuer: an authority's own.
Certificate new_certificate(const std::string& name, const Validity& validity, EVP_PKEY* key, X509* issuer,
                            EVP_PKEY* issuers_key) {
  Certificate certificate(X509_new());
  X509* const it = certificate.get();
  const Number serial(BN_new());
  check_openssl(it && serial && BN_rand(serial.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
                    BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(it)) != nullptr,
                "serial number");
  const auto* const common_name = reinterpret_cast<const unsigned char*>(name.c_str());
  check_openssl(
      X509_set_version(it, X509_VERSION_3) == 1 &&
          ASN1_TIME_set(X509_getm_notBefore(it), static_cast<time_t>(validity.begin_s)) != nullptr &&
          ASN1_TIME_set(X509_getm_notAfter(it), static_cast<time_t>(validity.end_s)) != nullptr &&
          X509_NAME_add_entry_by_txt(X509_get_subject_name(it), "CN", MBSTRING_UTF8, common_name, -1, -1, 0) == 1 &&
          X509_set_issuer_name(it, X509_get_subject_name(issuer ? issuer : it)) == 1 &&
          X509_set_pubkey(it, key) == 1,
      "certificate");
  add_extension(it, NID_basic_constraints, issuer ? "critical,CA:FALSE" : "critical,CA:TRUE");
  add_extension(it, NID_key_usage, issuer ? "critical,digitalSignature" : "critical,keyCertSign,digitalSignature");
  check_openssl(X509_sign(it, issuers_key, EVP_sha256()) > 0, "certificate");
  return certificate;
}

/// Throws Error unless the file holds one.
Certificate read_certificate(const PemFile& file) {
  Certificate certificate(PEM_read_bio_X509(reading(file.text).get(), nullptr, nullptr, nullptr));
  ERR_clear_error();
  if (!certificate) throw Error(file.path, "certificate", "none that can be read", "one of X.509, as PEM");
  return certificate;
}

std::string date(const ASN1_TIME* time) {
  std::tm parts = {};
  if (ASN1_TIME_to_tm(time, &parts) != 1) return "an unknown date";
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", parts);
}

}  // namespace

struct Authority::Parts {
  Key key;
  Certificate certificate;
};

Authority::Authority(const std::string& name, const Validity& validity) {
  Key key = new_key();
  Certificate certificate = new_certificate(name, validity, key.get(), nullptr, key.get());
  parts_ = std::make_unique<Parts>(std::move(key), std::move(certificate));
}

Authority::~Authority() = default;

std::string Authority::certificate() const {
  return pem(parts_->certificate.get());
}

Identity Authority::issue(const std::string& name, const Validity& validity) const {
  const Key key = new_key();
  const Certificate certificate =
      new_certificate(name, validity, key.get(), parts_->certificate.get(), parts_->key.get());
  return {pem(certificate.get()), pem(key.get())};
}

std::string Authority::sign(const std::string& text) const {
  const Signature signature(
      PKCS7_sign(parts_->certificate.get(), parts_->key.get(), nullptr, reading(text).get(), kSignatureFlags));
  check_openssl(signature != nullptr, "signature");
  return written("signature", [&](BIO* bio) {
    return SMIME_write_PKCS7(bio, signature.get(), reading(text).get(), kSignatureFlags);
  });
}

void check_certificate(const PemFile& certificate, int64_t now_s) {
  const Certificate read = read_certificate(certificate);
  auto now = static_cast<time_t>(now_s);
  const ASN1_TIME* const begin = X509_get0_notBefore(read.get());
  const ASN1_TIME* const end = X509_get0_notAfter(read.get());
  if (X509_cmp_time(begin, &now) > 0)
    throw Error(certificate.path, "certificate", "one that begins " + date(begin), "one that holds now");
  if (X509_cmp_time(end, &now) < 0)
    throw Error(certificate.path, "certificate", "one that expired " + date(end), "one that holds now");
}

void check_identity(const PemFile& certificate, const PemFile& private_key, const PemFile& authority) {
  const Certificate read = read_certificate(certificate), issuer = read_certificate(authority);
  const bool issued = X509_verify(read.get(), X509_get0_pubkey(issuer.get())) == 1;
  const auto no_password = [](char*, int, int, void*) { return 0; };
  const Key key(PEM_read_bio_PrivateKey(reading(private_key.text).get(), nullptr, no_password, nullptr));
  const bool fits = key && X509_check_private_key(read.get(), key.get()) == 1;
  ERR_clear_error();
  if (!issued) throw Error(certificate.path, "certificate", "one of another authority", "one of " + authority.path);
  if (!key) throw Error(private_key.path, "private key", "none that can be read", "one as PEM, without a password");
  if (!fits) throw Error(private_key.path, "private key", "another one", "that of " + certificate.path);
}

void check_signature(const PemFile& document, const PemFile& authority) {
  const Certificate issuer = read_certificate(authority);
  BIO* clear = nullptr;
  const Signature signature(SMIME_read_PKCS7(reading(document.text).get(), &clear));
  const Bio content(clear);
  const Store store(X509_STORE_new());
  check_openssl(store && X509_STORE_add_cert(store.get(), issuer.get()) == 1, "store of certificates");
  X509_STORE_set_flags(store.get(), X509_V_FLAG_NO_CHECK_TIME);  // that is check_certificate's
  const bool is_signed =
      signature && PKCS7_verify(signature.get(), nullptr, store.get(), content.get(), nullptr, PKCS7_TEXT) == 1;
  ERR_clear_error();
  if (!is_signed)
    throw Error(document.path, "signature", "none that fits", "a document that " + authority.path + " has signed");
}

}  // namespace glovebench
