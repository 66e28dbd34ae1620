#[path = "pressure_relief_valve/model.rs"]
mod model;
use model::*; use hybrid_system::*; use return_map::*;
fn main(){
 for q in [1.5,4.5,7.5] { let v=Valve{flow_rate:q}; 
  for tol in [1e-9,1e-10,4.9e-11,1e-11] {
  let map=ReturnMap::new(&v,&Turns,LIMITS);
  let mut at=START; let mut t=0.0; for _ in 0..100 { let r=map.next(&at).unwrap(); at=r.coordinates; t=r.time;}
  let (m,s)=Turns.point(&at);
  let t0=std::time::Instant::now(); let mut n=0; let mut f=std::cell::Cell::new(0);
  for _ in 0..200 { 
  let mut i=Integration::new(|_,y:&State<3>| {f.set(f.get()+1); v.vector_field(m,y)}, &s, Tolerances::both(tol)).unwrap();
   while i.interval().1<t { i.step().unwrap(); n+=1;}}
  let el=t0.elapsed().as_secs_f64();
  println!("q {q} tol {tol} steps {} fevals {} ns/step {:.0} us {:.1}", n/200, f.get()/200, el/n as f64*1e9, el/200.0*1e6);
 }}
}
