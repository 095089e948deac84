// OGRE: a skeleton with its animations, a SkeletonInstance for each character, without any render system.

#include <OgreAnimation.h>
#include <OgreAnimationState.h>
#include <OgreAnimationTrack.h>
#include <OgreBone.h>
#include <OgreKeyFrame.h>
#include <OgreLogManager.h>
#include <OgreRoot.h>
#include <OgreSkeletonInstance.h>
#include <OgreSkeletonManager.h>

#include "peer.h"

namespace surefoot::bench {
namespace {

Ogre::Vector3 to_ogre(Vec3 v) { return {v.x, v.y, v.z}; }
Ogre::Quaternion to_ogre(Quat q) { return {q.w, q.x, q.y, q.z}; }
std::string clip_name(std::size_t clip) { return "clip" + std::to_string(clip); }

/// OGRE's managers, silent and with no file.
struct OgreHouse {
    Ogre::LogManager log;
    std::unique_ptr<Ogre::Root> root;
    OgreHouse() {
        log.createLog("", true, false, true);
        root = std::make_unique<Ogre::Root>("", "", "");
    }
};

/// OGRE's keys are what a bone does beside its binding pose.
void add_animation(Ogre::Skeleton& skeleton, const PeerHero& hero, std::size_t clip) {
    Ogre::Animation* animation = skeleton.createAnimation(clip_name(clip), hero.seconds(hero.frames() - 1));
    for (std::size_t j = 0; j < hero.joints(); ++j) {
        const auto handle = static_cast<unsigned short>(j);
        Ogre::NodeAnimationTrack* track = animation->createNodeTrack(handle, skeleton.getBone(handle));
        const Transform& rest = hero.skeleton->rest[j];
        for (int f = 0; f < hero.frames(); ++f) {
            Ogre::TransformKeyFrame* key = track->createNodeKeyFrame(hero.seconds(f));
            key->setRotation(to_ogre(conjugate(rest.rotation) * hero.rotation(clip, f, j)));
            key->setTranslate(to_ogre(hero.translation(clip, f, j) - rest.translation));
        }
    }
}

class OgreCharacter {
  public:
    explicit OgreCharacter(const Ogre::SkeletonPtr& shared) : skeleton_(shared) {
        skeleton_.load();
        skeleton_._initAnimationState(&states_);
        for (std::size_t i = 0; i < k_mixed; ++i) {
            state_[i] = states_.getAnimationState(clip_name(i));
            state_[i]->setEnabled(true);
        }
    }
    void pose(const Moment& at, std::span<Matrix34> matrices) {
        for (std::size_t i = 0; i < k_mixed; ++i) {
            state_[i]->setTimePosition(at.seconds);
            state_[i]->setWeight(at.weights[i]);
        }
        skeleton_.setAnimationState(states_);
        skeleton_._updateTransforms();
        for (std::size_t j = 0; j < matrices.size(); ++j) {
            const Ogre::Affine3& m = skeleton_.getBone(static_cast<unsigned short>(j))->_getFullTransform();
            for (std::size_t k = 0; k < 12; ++k) matrices[j].m[k] = m[k / 4][k % 4];
        }
    }

  private:
    Ogre::SkeletonInstance skeleton_;
    Ogre::AnimationStateSet states_;
    std::array<Ogre::AnimationState*, k_mixed> state_{};
};

}  // namespace

std::unique_ptr<Peer> make_ogre_peer(const PeerHero& hero, std::size_t characters) {
    static const OgreHouse house;
    static int made = 0;
    const Ogre::SkeletonPtr shared = Ogre::SkeletonManager::getSingleton().create(
        "hero" + std::to_string(made++), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME, true);
    for (std::size_t j = 0; j < hero.joints(); ++j) {
        Ogre::Bone* bone = shared->createBone(hero.skeleton->names[j], static_cast<unsigned short>(j));
        bone->setPosition(to_ogre(hero.skeleton->rest[j].translation));
        bone->setOrientation(to_ogre(hero.skeleton->rest[j].rotation));
        if (const int parent = hero.skeleton->parents[j]; parent >= 0)
            shared->getBone(static_cast<unsigned short>(parent))->addChild(bone);
    }
    shared->setBindingPose();
    for (std::size_t i = 0; i < k_mixed; ++i) add_animation(*shared, hero, i);
    shared->load();
    auto peer = std::make_unique<OneByOne<OgreCharacter>>();
    for (std::size_t c = 0; c < characters; ++c) peer->characters.push_back(std::make_unique<OgreCharacter>(shared));
    return peer;
}

}  // namespace surefoot::bench
