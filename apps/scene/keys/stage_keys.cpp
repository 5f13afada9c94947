// [[stage]].
#include "apps/scene/keys/fix_keys.hpp"
#include "apps/scene/keys/scene_keys.hpp"
#include "apps/scene/keys/shape_keys.hpp"

namespace ashlar::keys {
namespace {

using Stage = SceneStage;
using StageFix = SceneStage::Fix;
using StageLoad = SceneStage::Load;

/// Blocks of an entry, and what is said of them.
template <class Entry, class Part>
std::vector<Key<Entry>> of_blocks(Part Entry::*part, std::vector<Key<Part>> keys) {
  std::vector<Key<Entry>> result = {
      blocks(&Entry::blocks, "names or globs"),
      inside(&Entry::inside, "only those inside, as in `[[assign]]`").not_written()};
  for (Key<Part>& key : keys) result.push_back(of(part, std::move(key)));
  return result;
}

const Keys<StageFix>& stage_fix_keys() {
  static const Keys<StageFix> table("", of_blocks(&StageFix::fix, keys_of_fix()),
                                    {all_inside<StageFix>, [](TomlTableReader& reader, StageFix& entry) {
                                       return check_fix(reader, entry.fix);
                                     }});
  return table;
}

const Keys<StageLoad>& stage_load_keys() {
  static const Keys<StageLoad> table("", of_blocks(&StageLoad::load, keys_of_load()),
                                     {all_inside<StageLoad>, [](TomlTableReader& reader, StageLoad& entry) {
                                        return check_load(reader, entry.load);
                                      }});
  return table;
}

/// A list of names and globs: an array of texts, or { blocks, inside }, whose blocks are "*" if they are left out.
struct StageBlocks {
  std::vector<std::string> blocks;
  std::optional<SceneRegion> inside;
};

const Keys<StageBlocks> block_list_table("",
                                         {blocks(&StageBlocks::blocks, "names or globs"),
                                          inside(&StageBlocks::inside,
                                                 "only those inside, as in `[[assign]]`")},
                                         {all_inside<StageBlocks>});

using NamesMember = std::vector<std::string> Stage::*;
using RegionMember = std::optional<SceneRegion> Stage::*;

template <NamesMember names, RegionMember region>
bool read_block_list(TomlTableReader& table, const std::string& key, Stage& stage) {
  const toml::table* content = table.table_at(key);
  if (content == nullptr || !(content->contains("inside") || content->contains("blocks")))
    return table.read_texts(key, stage.*names, " or { blocks, inside }");
  StageBlocks list;
  const bool good = block_list_table.read_table(table, key.c_str(), list);
  stage.*names = std::move(list.blocks);
  stage.*region = std::move(list.inside);
  return good;
}

template <NamesMember names, RegionMember region>
Key<Stage> block_list(const char* name, const char* meaning) {
  return own<Stage>(name,
                    {"an array of texts or { blocks, inside }",
                     [] {
                       return schema_of_any(
                           {schema_of_array(schema_of_text(), 0), block_list_table.table().schema()});
                     },
                     read_block_list<names, region>, [](const Stage& stage) { return Json(stage.*names); }},
                    "", meaning)
      .unless_empty()
      .otherwise("none");
}

const Keys<Stage> stage_table(
    "Excavation and construction",
    {name("name", &Stage::name, "each its own").required_always(),
     block_list<&Stage::remove, &Stage::remove_inside>(
         "remove",
         "blocks that are removed; `{ inside = { box = ... } }` those of the region that are there"),
     block_list<&Stage::add, &Stage::add_inside>(
         "add",
         "blocks that exist from this stage on, as they are placed. One that is deeper in a block that has "
         "moved there than `contact.allowed_depth` (auto: 1e-2 of the smaller block's size) ends the run as "
         "failed; a smaller overlap touches without force"),
     list<stage_fix_keys>(
         "fix", &Stage::fix,
         "supports: `blocks` and the keys of `[[block.fix]]`; they hold blocks where they are")
         .described_elsewhere(),
     list<stage_load_keys>("load", &Stage::load,
                           "loads: `blocks` and the keys of `[[block.load]]`, beside those there are")
         .described_elsewhere(),
     list<joint_keys>("joint", &Stage::joint, "as `[[joint]]`, later than all before; it cannot tie")
         .described_elsewhere(),
     list<material_keys>("material", &Stage::material,
                         "as `[[material]]`, in place of the one of that name; blocks keep their shape")
         .described_elsewhere(),
     list<water_keys>("water", &Stage::water,
                      "as `[[water]]`, in place of the one of that name, or beside the others")
         .described_elsewhere(),
     list<bolt_keys>("bolt", &Stage::bolt,
                     "as `[[bolt]]`, installed at the start of the stage where the blocks are then, without "
                     "forces but for the pretension")
         .described_elsewhere(),
     list<prop_keys>("prop", &Stage::prop, "as `[[prop]]`, the same").described_elsewhere(),
     names("remove_support", &Stage::remove_support, "names or globs of bolts and props that are removed")
         .unless_empty(),
     flag("reset_displacement", &Stage::reset_displacement,
          "displacements in results count from the start of the stage"),
     table<analysis_keys>("analysis", &Stage::analysis,
                          "keys of `[analysis]`, each in place of its value there; `formulation` and "
                          "`initial_state` are those of the run")
         .otherwise("that of `[analysis]`")
         .described_elsewhere()});

}  // namespace

const Keys<SceneStage>& stage_keys() {
  return stage_table;
}

}  // namespace ashlar::keys
