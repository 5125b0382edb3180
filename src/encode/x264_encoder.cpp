#include "encode/x264_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <utility>

#include "encode/codecs.hpp"
#include "encode/x264_functions.hpp"

namespace chainreel {
namespace {

// What stands still is as a group's first frame has it, so that this one is made finely and what moves by less. Four times a second
// another frame is as fine: what has come to rest since then, or uncovered what was behind it, leaves nothing behind, as blocks
// that stand still are passed over only where they are as fine. Without it specks and broken lines lay on dark pages until the next
// group. Two dark and light films at 1280x720: 44.6 and 47.3 dB of PSNR, 43.9 and 46.7 with frames measured by x264 (crf 27, and 15
// finer at first), which took 1.4 and 1.6 times the work, for files of 16 and 24 % less.
// These are fixed quantisers: x264's own measure of quality (crf) has to look at each frame of half the size before, a seventh of
// its work, and at what lasts by frames ahead (mbtree), which cost 2 dB of PSNR for files of the same size.
constexpr double kCoarserWhereMoved = 14, kFinerAtFirst = 2;  // than crf
constexpr double kFinePerSecond = 4;
constexpr double kWorst = 51;

struct Quantisers {
  int first, moved;
};

// From 0, without loss, to 51.
Quantisers quantisers_of(double crf) {
  if (crf == 0) return {0, 0};
  const auto off = [crf](double by) { return int(std::clamp(crf + by, 1.0, kWorst)); };
  return {off(-kFinerAtFirst), off(kCoarserWhereMoved)};
}

// Beside the preset veryfast as it is: one thread and the same bytes whichever instruction set x264 finds; groups of fixed
// bounds; no frame between two others, none looked at ahead, no weights of references, as nothing fades; motion sought by whole
// pixels, as most of them stand still. No block is called still that is not (fast-pskip, dct-decimate), which left specks where
// lines had been; and no filter across edges of blocks: lines were less true by it, and it took a tenth of the time.
void set_up(x264_param_t& to, const VideoSettings& settings) {
  const Quantisers quantisers = quantisers_of(crf_of(settings));
  to.i_threads = 1;
  to.i_lookahead_threads = 1;
  to.b_cpu_independent = 1;
  to.i_width = settings.width;
  to.i_height = settings.height;
  to.i_csp = X264_CSP_I420;
  to.i_fps_num = std::uint32_t(settings.fps.num);
  to.i_fps_den = std::uint32_t(settings.fps.den);
  to.i_timebase_num = std::uint32_t(settings.fps.den);
  to.i_timebase_den = std::uint32_t(settings.fps.num);
  to.b_vfr_input = 0;
  to.b_repeat_headers = 0;
  to.vui.i_sar_width = to.vui.i_sar_height = 1;
  to.vui.b_fullrange = 0;
  to.vui.i_colorprim = to.vui.i_transfer = to.vui.i_colmatrix = 1;  // BT.709
  to.vui.i_chroma_loc = 1;                                          // in the centre, as yuv.hpp computes it
  to.i_keyint_max = to.i_keyint_min = gop_of(settings.fps);
  to.i_scenecut_threshold = 0;
  to.b_open_gop = 0;
  to.i_bframe = 0;
  to.rc.i_rc_method = X264_RC_CQP;
  to.rc.i_qp_constant = quantisers.moved;
  to.rc.f_ip_factor = float(std::exp2((quantisers.moved - quantisers.first) / 6.0));
  to.rc.i_lookahead = 0;
  to.rc.b_mb_tree = 0;
  to.rc.i_aq_mode = X264_AQ_NONE;
  to.analyse.i_me_method = X264_ME_DIA;
  to.analyse.i_subpel_refine = 0;
  to.analyse.i_weighted_pred = X264_WEIGHTP_NONE;
  to.analyse.b_fast_pskip = 0;
  to.analyse.b_dct_decimate = 0;
  to.analyse.b_mb_info = 1;
  to.b_deblocking_filter = 0;
}

void keep_line(void* lines, int level, const char* format, va_list values) {
  if (level > X264_LOG_ERROR) return;
  char line[256];
  std::vsnprintf(line, sizeof line, format, values);
  std::string& said = *static_cast<std::string*>(lines);
  said += line;
  while (!said.empty() && said.back() == '\n') said.back() = ' ';
}

}  // namespace

struct X264Encoder::State {
  std::string said;  // lines of errors
  x264_t* encoder = nullptr;
  int fine;        // quantiser of frames that are as fine as the first
  int until_fine;  // frames from one of them to the next
  int frames = 0;

  explicit State(const VideoSettings& settings)
      : fine(quantisers_of(crf_of(settings)).first),
        until_fine(std::max(1, int(std::lround(settings.fps.value() / kFinePerSecond)))) {
    x264_param_t parameters;
    x264().x264_param_default_preset(&parameters, "veryfast", nullptr);
    set_up(parameters, settings);
    // Without loss it is High 4:4:4 Predictive, whatever the pixels.
    if (parameters.rc.i_qp_constant > 0) x264().x264_param_apply_profile(&parameters, "high");
    parameters.i_log_level = X264_LOG_ERROR;
    parameters.pf_log = keep_line;
    parameters.p_log_private = &said;
    encoder = x264().x264_encoder_open(&parameters);
    if (encoder == nullptr) fail();
  }
  ~State() {
    if (encoder != nullptr) x264().x264_encoder_close(encoder);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  // Where x264 gets no memory it says so on standard error alone.
  [[noreturn]] void fail() const {
    if (said.empty() || said.find("alloc") != std::string::npos)
      throw Error(ExitCode::limit, "x264 failed: out of memory: take a smaller picture or fewer --jobs");
    throw Error(ExitCode::no_renderer, "x264 failed: " + said);
  }
};

X264Encoder::X264Encoder(const VideoSettings& settings) : state_(std::make_unique<State>(settings)) {}
X264Encoder::~X264Encoder() = default;

std::string X264Encoder::head() const {
  x264_nal_t* units = nullptr;
  int count = 0;
  if (x264().x264_encoder_headers(state_->encoder, &units, &count) < 0) state_->fail();
  std::string head;
  for (int i = 0; i < count; ++i)
    if (units[i].i_type == NAL_SPS || units[i].i_type == NAL_PPS)
      head.append(reinterpret_cast<const char*>(units[i].p_payload), std::size_t(units[i].i_payload));
  return head;
}

FilmPacket X264Encoder::encode(const AVFrame& frame, StillBlocks::Flags& still) {
  x264_picture_t picture, coded;
  x264().x264_picture_init(&picture);
  picture.i_pts = frame.pts;
  if (const int k = state_->frames++; state_->fine > 0 && k > 0 && k % state_->until_fine == 0) picture.i_qpplus1 = state_->fine + 1;
  picture.img.i_csp = X264_CSP_I420;
  picture.img.i_plane = 3;
  for (int i = 0; i < 3; ++i) {
    picture.img.plane[i] = frame.data[i];
    picture.img.i_stride[i] = frame.linesize[i];
  }
  static_assert(X264_MBINFO_CONSTANT == 1, "as flags of still blocks are");
  if (!still.empty()) picture.prop.mb_info = still.data();
  x264_nal_t* units = nullptr;
  int count = 0;
  // Units lie behind one another. None of the frames is looked at ahead, none waits for another thread.
  const int bytes = x264().x264_encoder_encode(state_->encoder, &units, &count, &picture, &coded);
  if (bytes <= 0) state_->fail();
  return {.data = std::string(reinterpret_cast<const char*>(units[0].p_payload), std::size_t(bytes)),
          .opacity = {},
          .pts = coded.i_pts,
          .is_key = coded.b_keyframe != 0};
}

}  // namespace chainreel
