// osgAnimation: a tree of bones for each character; keys are shared, channels and targets cannot be.

#include <osgAnimation/Animation>
#include <osgAnimation/Bone>
#include <osgAnimation/Skeleton>
#include <osgAnimation/StackedQuaternionElement>
#include <osgAnimation/StackedTranslateElement>
#include <osgAnimation/UpdateBone>
#include <osgUtil/UpdateVisitor>

#include "peer.h"

namespace surefoot::bench {
namespace {

osg::Vec3f to_osg(Vec3 v) { return {v.x, v.y, v.z}; }
osg::Quat to_osg(Quat q) { return {q.x, q.y, q.z, q.w}; }

struct OsgKeys {
    std::vector<osg::ref_ptr<osgAnimation::QuatKeyframeContainer>> rotations;  // by joint
    osg::ref_ptr<osgAnimation::Vec3KeyframeContainer> translations;            // of the first joint
};

OsgKeys make_keys(const PeerHero& hero, std::size_t clip) {
    OsgKeys keys;
    for (std::size_t j = 0; j < hero.joints(); ++j) {
        keys.rotations.emplace_back(new osgAnimation::QuatKeyframeContainer);
        for (int f = 0; f < hero.frames(); ++f)
            keys.rotations[j]->push_back({hero.seconds(f), to_osg(hero.rotation(clip, f, j))});
    }
    keys.translations = new osgAnimation::Vec3KeyframeContainer;
    for (int f = 0; f < hero.frames(); ++f)
        keys.translations->push_back({hero.seconds(f), to_osg(hero.translation(clip, f, 0))});
    return keys;
}

template <class Channel, class Keys>
void add_channel(osgAnimation::Animation& animation, Keys* keys, osgAnimation::Target* target) {
    osg::ref_ptr<Channel> channel = new Channel;
    channel->getOrCreateSampler()->setKeyframeContainer(keys);
    channel->setTarget(target);
    animation.addChannel(channel.get());
}

class OsgCharacter {
  public:
    OsgCharacter(const PeerHero& hero, const std::array<OsgKeys, k_mixed>& keys)
        : skeleton_(new osgAnimation::Skeleton) {
        for (auto& animation : animations_) animation = new osgAnimation::Animation;
        for (std::size_t j = 0; j < hero.joints(); ++j) add_bone(hero, keys, j);
        for (auto& animation : animations_) animation->computeDuration();
        skeleton_->accept(visitor_);
    }
    void pose(const Moment& at, std::span<Matrix34> matrices) {
        for (auto& animation : animations_) animation->resetTargets();
        for (std::size_t i = 0; i < k_mixed; ++i) {
            animations_[i]->setWeight(at.weights[i]);
            animations_[i]->update(at.seconds);
        }
        skeleton_->accept(visitor_);
        for (std::size_t j = 0; j < matrices.size(); ++j) {
            const osg::Matrix& m = bones_[j]->getMatrixInSkeletonSpace();
            for (int k = 0; k < 12; ++k) matrices[j].m[k] = static_cast<float>(m(k % 4, k / 4));
        }
    }

  private:
    void add_bone(const PeerHero& hero, const std::array<OsgKeys, k_mixed>& keys, std::size_t j) {
        const Transform& rest = hero.skeleton->rest[j];
        osg::ref_ptr<osgAnimation::Bone> bone = new osgAnimation::Bone(hero.skeleton->names[j]);
        osg::ref_ptr<osgAnimation::UpdateBone> update = new osgAnimation::UpdateBone(hero.skeleton->names[j]);
        osg::ref_ptr<osgAnimation::StackedTranslateElement> place =
            new osgAnimation::StackedTranslateElement("translate", to_osg(rest.translation));
        osg::ref_ptr<osgAnimation::StackedQuaternionElement> turn =
            new osgAnimation::StackedQuaternionElement("quaternion", to_osg(rest.rotation));
        update->getStackedTransforms().push_back(place.get());
        update->getStackedTransforms().push_back(turn.get());
        bone->setUpdateCallback(update.get());
        for (std::size_t i = 0; i < k_mixed; ++i) {
            add_channel<osgAnimation::QuatSphericalLinearChannel>(*animations_[i], keys[i].rotations[j].get(),
                                                                  turn->getOrCreateTarget());
            if (j == 0)
                add_channel<osgAnimation::Vec3LinearChannel>(*animations_[i], keys[i].translations.get(),
                                                             place->getOrCreateTarget());
        }
        const int parent = hero.skeleton->parents[j];
        if (parent < 0)
            skeleton_->addChild(bone.get());
        else
            bones_[static_cast<std::size_t>(parent)]->addChild(bone.get());
        bones_.push_back(bone);
    }

    osg::ref_ptr<osgAnimation::Skeleton> skeleton_;
    std::vector<osg::ref_ptr<osgAnimation::Bone>> bones_;
    std::array<osg::ref_ptr<osgAnimation::Animation>, k_mixed> animations_;
    osgUtil::UpdateVisitor visitor_;
};

}  // namespace

std::unique_ptr<Peer> make_osg_peer(const PeerHero& hero, std::size_t characters) {
    std::array<OsgKeys, k_mixed> keys;
    for (std::size_t i = 0; i < k_mixed; ++i) keys[i] = make_keys(hero, i);
    auto peer = std::make_unique<OneByOne<OsgCharacter>>();
    for (std::size_t c = 0; c < characters; ++c) peer->characters.push_back(std::make_unique<OsgCharacter>(hero, keys));
    return peer;
}

}  // namespace surefoot::bench
