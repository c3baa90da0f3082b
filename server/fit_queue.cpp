#include "server/fit_queue.h"

#include "calibration/pieces/piece_refit.h"

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

// The system shares its cores among them, so that a fit of a moment ends beside those of minutes.
constexpr int kFitsAtOnce = 4;
// As many as the renderer keeps on the GPU.
constexpr size_t kFitsKept = 16;

// What they cost, and so the choice among all methods, follows from how many there are.
bool needsPieces(Method method) { return method == Method::piecewise || method == Method::automatic; }

}  // namespace

FitQueue::FitQueue(RenderQueue::Settings settings, RenderQueue& renders, FitFunction fit, RefitFunction refit)
    : settings_(std::move(settings)),
      renders_(renders),
      fit_(std::move(fit)),
      refit_(std::move(refit)),
      fitted_(kFitsKept),
      latest_(kFitsKept) {
    for (int i = 0; i < kFitsAtOnce; ++i) threads_.emplace_back([this] { work(); });
}

FitQueue::~FitQueue() { stop(); }

void FitQueue::submit(RenderQueue::Job job) {
    job.arrived = settings_.now();
    if (!needsPieces(job.call.request.method)) return renders_.submit(std::move(job));
    sweep();
    const Key key = keyOf(job.call.request);
    std::unique_lock lock(mutex_);
    if (const auto fitted = fitted_.find(key)) {
        lock.unlock();
        return goOn(std::move(job), *fitted);
    }
    if (stopping_ || jobCount() >= settings_.length) {
        const Refusal refusal{stopping_ ? Refusal::Reason::stopping : Refusal::Reason::full, retryAfter()};
        lock.unlock();
        return job.done(refusal);
    }
    auto fit = std::ranges::find(fits_, key, [](const auto& each) -> const Key& { return each->key; });
    if (fit == fits_.end()) {
        fit = fits_.insert(fit, std::make_shared<Fit>(Fit{key}));
        changed_.notify_one();
    }
    (*fit)->jobs.push_back(std::move(job));
}

void FitQueue::sweep() {
    std::vector<std::pair<RenderQueue::Job, Refusal>> refused;
    {
        std::scoped_lock lock(mutex_);
        for (const auto& fit : fits_) {
            std::erase_if(fit->jobs, [&](RenderQueue::Job& job) {
                auto reason = reasonToRefuse(job, settings_);
                if (reason == Refusal::Reason::late && fit->begun) reason = Refusal::Reason::fitting;
                if (reason) refused.emplace_back(std::move(job), Refusal{*reason, retryAfter()});
                return reason.has_value();
            });
            if (fit->jobs.empty()) fit->stop.request_stop();
        }
        std::erase_if(fits_, [](const auto& fit) { return fit->jobs.empty(); });
    }
    for (const auto& [job, refusal] : refused) job.done(refusal);
}

void FitQueue::stop() {
    std::vector<RenderQueue::Job> refused;
    {
        std::scoped_lock lock(mutex_);
        stopping_ = true;
        for (const auto& fit : fits_) {
            fit->stop.request_stop();
            std::ranges::move(std::exchange(fit->jobs, {}), std::back_inserter(refused));
        }
        fits_.clear();
        for (const auto& completion : completions_) completion->stop.request_stop();
        completions_.clear();
    }
    changed_.notify_all();
    for (const RenderQueue::Job& job : refused)
        job.done(Refusal{Refusal::Reason::stopping, std::chrono::seconds(1)});
}

FitQueue::Key FitQueue::keyOf(const RenderRequest& request) {
    return {{request.wall, &findDisplay(*request.wall, request.display), request.tolerancePx}, request.eyeM};
}

std::shared_ptr<const FitQueue::Fitted> FitQueue::fittedFor(const Fit& fit, const Fitted* before) const {
    const Screen& screen = fit.key.screen;
    Fitted fitted{fit.sparse ? fit.sparse->wall : screen.wall, nullptr};
    if (fit.key.eyeM && !fit.sparse)
        fitted.wall = std::make_shared<const Wall>(seenFrom(*screen.wall, *fit.key.eyeM));
    const Display& display = findDisplay(*fitted.wall, screen.display->name);
    const int every = fit.sparse ? 1 : kSparseRows;
    FittedPieces pieces =
        before ? refit_(*before->pieces, display, screen.tolerancePx, every, fit.stop.get_token())
               : fit_(display, screen.tolerancePx, fit.stop.get_token());
    pieces.errorsPx = {};  // a float a pixel that no render asks for
    fitted.pieces = std::make_shared<const FittedPieces>(std::move(pieces));
    return std::make_shared<const Fitted>(std::move(fitted));
}

void FitQueue::goOn(RenderQueue::Job job, const Fitted& fitted) {
    job.call.request.wall = fitted.wall;
    job.call.request.eyeM.reset();
    job.call.request.pieces = fitted.pieces;
    renders_.submit(std::move(job));
}

void FitQueue::work() {
    while (const std::shared_ptr<Fit> fit = takeNext()) {
        std::shared_ptr<const Fitted> before = fit->sparse, fitted;
        if (fit->key.eyeM && !before) {
            std::scoped_lock lock(mutex_);
            before = latest_.find(fit->key.screen);
        }
        std::exception_ptr failure;
        try {
            fitted = fittedFor(*fit, before.get());
        } catch (...) {
            failure = std::current_exception();
        }
        std::vector<RenderQueue::Job> jobs;  // none where the fit was stopped
        {
            std::scoped_lock lock(mutex_);
            if (fitted) keep(*fit, fitted);
            jobs.swap(fit->jobs);
            std::erase(fits_, fit);
            std::erase(completions_, fit);
        }
        for (RenderQueue::Job& job : jobs) {
            if (fitted)
                goOn(std::move(job), *fitted);
            else
                job.done(failure);
        }
    }
}

// Where the eye has gone on while a certificate was completed, the next refit starts from there all the same:
// that is the certificate whose age is told, and where cells were cut they will be wanted again.
void FitQueue::keep(const Fit& fit, const std::shared_ptr<const Fitted>& fitted) {
    const Screen& screen = fit.key.screen;
    fitted_.put(fit.key, fitted);
    latest_.put(screen, fitted);
    if (fitted->pieces->certificate.every == 1) return;
    // Only the latest eye's certificate is worth the time.
    std::erase_if(completions_, [&](const auto& each) { return !each->begun && each->key.screen == screen; });
    completions_.push_back(std::make_shared<Fit>(Fit{.key = fit.key, .sparse = fitted}));
    changed_.notify_one();
}

std::shared_ptr<FitQueue::Fit> FitQueue::takeNext() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return stopping_ || next(); });
    std::shared_ptr<Fit> fit = next();
    if (fit) fit->begun = true;
    return fit;
}

size_t FitQueue::jobCount() const {
    size_t count = 0;
    for (const auto& fit : fits_) count += fit->jobs.size();
    return count;
}

std::shared_ptr<FitQueue::Fit> FitQueue::next() const {
    const auto waiting = std::ranges::find(fits_, false, [](const auto& fit) { return fit->begun; });
    if (waiting != fits_.end()) return *waiting;
    const auto completion = std::ranges::find_if(completions_, [this](const auto& each) {
        return !each->begun && !isBeingCompleted(each->key.screen);
    });
    return completion == completions_.end() ? nullptr : *completion;
}

bool FitQueue::isBeingCompleted(const Screen& screen) const {
    return std::ranges::any_of(completions_,
                               [&](const auto& each) { return each->begun && each->key.screen == screen; });
}

// By then each that waits now has its answer.
std::chrono::seconds FitQueue::retryAfter() const {
    return std::chrono::ceil<std::chrono::seconds>(settings_.deadline);
}

}  // namespace curvewall
