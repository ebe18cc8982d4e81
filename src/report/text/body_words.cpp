#include "report/text/body_words.h"

#include <algorithm>

namespace subimpact {
namespace {

struct Words {
  BodyPart part;
  const char *label, *remedy;
};
constexpr Words words_of_parts[] = {
    {BodyPart::shear, "shear", "beam.theory = \"timoshenko\" models it"},
    {BodyPart::shear_coefficient, "shear coefficient",
     "give beam.shear_coefficient where it is known better than to 2 %"},
    {BodyPart::poisson, "Poisson's ratio", "give beam.poisson or beam.material"},
    {BodyPart::bending, "bending", "model a beam that bends"},
    {BodyPart::contact_law, "contact law", "give the measured curve: contact.law = \"curve\""},
    {BodyPart::nose, "nose", "give contact.striker_modulus and contact.striker_poisson"},
    {BodyPart::gravity, "gravity", "scene.gravity = 9.81, or 0 for a level strike"},
    {BodyPart::width, "width of the hinge", "measure the permanent set once"},
    {BodyPart::finite_rotations, "finite rotations",
     "strike more softly, or compare with a 3-D solid"},
    {BodyPart::stretching, "stretching of beam",
     "beam.axial = \"held\" or \"free\", as the supports are"},
    {BodyPart::support, "support stiffness",
     "measure it, and give beam.springs with one_sided = true for ends that rest"},
    {BodyPart::hinge_length, "length of the hinge", "no theory of beams knows it"},
    {BodyPart::thin_openings, "thin openings", "count gaps so thin as closed: --opening 10um"}};

const Words& words_of(BodyPart part) {
  return *std::ranges::find(words_of_parts, part, &Words::part);
}

}  // namespace

std::string label_of(BodyPart part) { return words_of(part).label; }

std::string remedy_of(BodyPart part) { return words_of(part).remedy; }

}  // namespace subimpact
