// Cal3D: a core model shared by all characters, a CalModel for each, its own mixer.

#include <cal3d/cal3d.h>
#include <cal3d/corekeyframe.h>
#include <cal3d/coretrack.h>

#include "peer.h"

namespace surefoot::bench {
namespace {

CalVector to_cal(Vec3 v) { return {v.x, v.y, v.z}; }
/// Cal3D's quaternions turn the other way.
CalQuaternion to_cal(Quat q) { return {-q.x, -q.y, -q.z, q.w}; }
Quat from_cal(const CalQuaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

CalCoreAnimation* make_animation(const PeerHero& hero, std::size_t clip) {
    auto* animation = new CalCoreAnimation;
    animation->setDuration(hero.seconds(hero.frames() - 1));
    for (std::size_t j = 0; j < hero.joints(); ++j) {
        auto* track = new CalCoreTrack;
        track->create();
        track->setCoreBoneId(static_cast<int>(j));
        for (int f = 0; f < hero.frames(); ++f) {
            auto* key = new CalCoreKeyframe;
            key->create();
            key->setTime(hero.seconds(f));
            key->setRotation(to_cal(hero.rotation(clip, f, j)));
            key->setTranslation(to_cal(hero.translation(clip, f, j)));
            track->addCoreKeyframe(key);
        }
        animation->addCoreTrack(track);
    }
    return animation;
}

class CalCharacter {
  public:
    explicit CalCharacter(CalCoreModel* core) : model_(core) {
        for (std::size_t i = 0; i < k_mixed; ++i) model_.getMixer()->blendCycle(static_cast<int>(i), 1, 0);
        model_.getMixer()->updateAnimation(0);
    }
    void pose(const Moment& at, std::span<Matrix34> matrices) {
        CalMixer* mixer = model_.getMixer();
        for (std::size_t i = 0; i < k_mixed; ++i) mixer->blendCycle(static_cast<int>(i), at.weights[i], 0);
        mixer->updateAnimation(0);  // takes the weights over; time stands
        mixer->setAnimationTime(at.seconds);
        mixer->updateAnimation(0);
        mixer->updateSkeleton();
        const std::vector<CalBone*>& bones = model_.getSkeleton()->getVectorBone();
        for (std::size_t j = 0; j < bones.size(); ++j) {
            const CalVector& at_joint = bones[j]->getTranslationAbsolute();
            matrices[j] = to_matrix({from_cal(bones[j]->getRotationAbsolute()), {at_joint.x, at_joint.y, at_joint.z}});
        }
    }

  private:
    CalModel model_;
};

class CalPeer : public OneByOne<CalCharacter> {
  public:
    explicit CalPeer(const PeerHero& hero) : core_("hero") {
        auto* skeleton = new CalCoreSkeleton;
        core_.setCoreSkeleton(skeleton);
        for (std::size_t j = 0; j < hero.joints(); ++j) {
            auto* bone = new CalCoreBone(hero.skeleton->names[j]);
            bone->setCoreSkeleton(skeleton);
            const int parent = hero.skeleton->parents[j];
            bone->setParentId(parent);
            bone->setTranslation(to_cal(hero.skeleton->rest[j].translation));
            bone->setRotation(to_cal(hero.skeleton->rest[j].rotation));
            const int id = skeleton->addCoreBone(bone);
            if (parent >= 0) skeleton->getCoreBone(parent)->addChildId(id);
        }
        skeleton->calculateState();
        for (std::size_t i = 0; i < k_mixed; ++i) core_.addCoreAnimation(make_animation(hero, i));
    }
    ~CalPeer() override { characters.clear(); }  // before what they share
    CalCoreModel& core() { return core_; }

  private:
    CalCoreModel core_;
};

}  // namespace

std::unique_ptr<Peer> make_cal3d_peer(const PeerHero& hero, std::size_t characters) {
    auto peer = std::make_unique<CalPeer>(hero);
    for (std::size_t c = 0; c < characters; ++c)
        peer->characters.push_back(std::make_unique<CalCharacter>(&peer->core()));
    return peer;
}

}  // namespace surefoot::bench
