use passive_hopper::*;
use std::collections::BTreeMap;
fn main(){
 for f in std::env::args().skip(1){
  let t=std::fs::read_to_string(&f).unwrap(); let mut by:BTreeMap<String,(usize,f64,String,usize,Vec<f64>)>=Default::default();
  for l in t.lines(){ let v:serde_json::Value=serde_json::from_str(l).unwrap(); let m=v["mass_ratio"].as_f64().unwrap(); let a=v["alpha"].as_f64().unwrap();
   let e=by.entry(v["class"].as_str().unwrap().into()).or_default(); e.0+=1;
   let sud=v["sudden"].as_u64().unwrap() as usize;
   let want=v["alpha_next"].as_str().map(|s|s.parse::<f64>().unwrap());
   let h=match LiftOffMap::new(MassRatio::new(m).unwrap()).hop(a){Ok(h)=>h,Err(x)=>{println!("{x}");e.3+=1;continue}};
   if h.sudden!=sud || h.next.is_some()!=want.is_some() { e.3+=1; if e.3<6 {println!("wrong {} vs {sud} {:?} {want:?} rad {} {l:.120}",h.sudden,h.next,h.radicand);} continue;}
   if let Some(w)=want{ let da=v["dalpha_next_dalpha"].as_str().map_or(0.0,|s|s.parse::<f64>().unwrap()); let dm=v["dalpha_next_dM"].as_str().map_or(0.0,|s|s.parse::<f64>().unwrap());
    let n=h.next.unwrap(); let k=(n-w).abs()/(f64::EPSILON/2.0*(w.abs()+da.abs()*a+dm.abs()*m+a*a/w)); e.4.push(k/(1.0+sud as f64)); if k>e.1{e.1=k; e.2=l[..l.len().min(140)].into();} }
  }
  for (c,mut e) in by{ e.4.sort_by(f64::total_cmp); println!("{f} {c}: n={} worst K={:.2} wrong={} K/(1+s): med {:.2} max {:.2} | {}",e.0,e.1,e.3,e.4[e.4.len()/2],e.4.last().unwrap(),e.2);}
 }
}
