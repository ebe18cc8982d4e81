#include "subimpact/simulate/simulate.h"
#include <fmt/format.h>
#include <cstdlib>
#include <cstring>
using namespace subimpact;
int main(int argc,char**argv){
  Case c; auto&b=c.scene.beam; b.length=0.7112;b.width=0.0163;b.thickness=0.0075;b.density=2600;b.youngs_modulus=71.96e9;b.yield_stress=150e6;
  auto&s=c.scene.striker; s.mass=0.201;s.nose_radius=0.01;s.velocity=15.9; c.end_time=2e-3; c.output.interval=0;
  for(int i=1;i<argc;++i){ std::string a=argv[i]; auto v=[&]{return std::string(argv[++i]);};
   if(a=="-m"){auto m=v(); c.solver.method= m=="cd"?Method::central_difference: m.rfind("dprkn",0)==0?Method::nystrom:Method::erk; if(m!="cd") c.solver.table=m;}
   else if(a=="-s"){auto m=v(); c.model.section = m=="elastic"?SectionKind::elastic: m=="exact"?SectionKind::exact:SectionKind::layers;}
   else if(a=="-r") c.solver.rtol=atof(v().c_str());
   else if(a=="-h") c.solver.step=atof(v().c_str());
   else if(a=="-t") c.end_time=atof(v().c_str());
   else if(a=="-i") c.output.interval=atof(v().c_str());
   else if(a=="-n") c.model.segments=atoi(v().c_str());
   else if(a=="-full") c.model.symmetry=SymmetryUse::off;
   else if(a=="-klu") c.solver.mass_solver=MassSolverKind::klu;
   else if(a=="-lib") c.solver.vector_operations=VectorOperationsKind::library;
   else if(a=="-noloc") c.solver.reversals=ReversalHandling::step_end;
   else if(a=="-ev") c.solver.events=v()=="i"?EventHandling::interpolated:EventHandling::located;
  }
  Result r=simulate(c);
  // reference
  const char* ref=getenv("REF");
  FILE* f=ref?fopen(ref,"r"):nullptr; char line[300]; if(f) fgets(line,300,f);
  double worst=0, worstl=0, last=0; int idx=0;
  for(auto&e:r.sub_impacts){ double a=0,z=0,l=0,er=0;int k;
    if(f&&fgets(line,300,f)) sscanf(line,"%d,%lf,%lf,%lf,%lf",&k,&a,&z,&l,&er);
    double ds=e.start*1e6-a, de=e.end.value_or(0)*1e6-z, dl=e.max_indentation*1e3/l-1;
    if(getenv("V")) fmt::print("{:3} {:14.7f} {:14.7f} {:.9f}  d {:+.2e} {:+.2e} l {:+.1e} ({:.0e}) F {:.2f} J {:.5f} z{}.{}\n",++idx,e.start*1e6,e.end.value_or(0)*1e6,e.max_indentation*1e3,ds,de,dl,er,e.peak_force,e.impulse,e.zone,e.subzone);
    worst=std::max({worst,std::abs(ds),std::abs(de)}); worstl=std::max(worstl,std::abs(dl)); last=de;
  }
  fmt::print("{} t={:.6g}us n={} worst {:.2e} last {:.2e} lam {:.1e} | steps {} rej {} part {} rhs {} events {} wall {:.3f} setup {:.4f} us/rhs {:.3f} | E {:.1e} P {:.1e} yield {:.4f} us ({}) {} tr\n", r.outcome.message, r.outcome.time*1e6, r.sub_impacts.size(), worst,last,worstl,r.work.steps,r.work.rejected_steps,r.work.partial_steps,r.work.right_hand_sides,r.work.roots,r.work.wall_seconds,r.work.setup_seconds,1e6*r.work.wall_seconds/r.work.right_hand_sides,r.max_energy_error,r.max_momentum_error,r.first_section_yield.value_or(0)*1e6,r.n_yielded_sections,r.transitions.size());
}
