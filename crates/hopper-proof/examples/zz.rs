use hopper_proof::*; use hopper_basin::*; use std::time::Instant;
fn main(){
  for n in 1..=4 { let t=Touch::new(n).unwrap(); let m=t.mass_ratio(); println!("n={n} M_c=[{}, {}] width {:e}", m.low,m.high,m.width()); }
  let a: Vec<f64> = std::env::args().skip(1).map(|x| x.parse().unwrap()).collect();
  let (m, dm, speeds, pixels, tol) = (a[0], a[1], a[2] as usize, a[3] as usize, a[4]);
  let strip = Strip::between(m, m+dm).unwrap();
  for n in 0..=6 { println!("{n} {:?}", proved_trap(n,&strip)); }
  let (b,t)=(fixed_point(1).low, fixed_point(6).low);
  let now=Instant::now();
  let line = ProvedLine::new(strip,basin_of_attraction::Interval{left:b,right:t},pixels,tol,speeds).unwrap();
  let s=now.elapsed().as_secs_f64();
  let mut sums=[0.0;9]; let mut known=0.0;
  for (i,l) in line.intervals() { let len=(i.right.min(t)-i.left.max(b)).max(0.0); known+=len; 
    let k= (0..6u64).find(|&k| *l==HopperFate::label_of_fixed_point(k)).map(|k| k as usize).unwrap_or(7); sums[k]+=len; }
  println!("intervals {} time {s:.3} open {:e} of {}", line.intervals().len(), (t-b)-known, t-b);
  for k in 0..9 { if sums[k]>0.0 { println!(" {k}: {:.12}", sums[k]/(t-b)); } }
  let mut gaps: Vec<(f64,f64)>=Vec::new(); let mut at=b; for (i,_) in line.intervals() { if i.right<b {continue;} if i.left>at { gaps.push((i.left-at,at)); } at=i.right; } gaps.push((t-at,at));
  gaps.sort_by(|x,y| y.0.total_cmp(&x.0)); let im=ProvedImages::new(strip,t).unwrap(); for (w,x) in gaps.iter().take(8) { println!("gap {w:e} at {x} [pi {:.4}] F {:?} {:?}", x/std::f64::consts::PI, im.of_speed(*x), im.of_speed(x+w)); }
  println!("gaps {}", gaps.len());
  let mut show=|lo:f64,hi:f64| { let mut seen=0; for (i,l) in line.intervals().iter().filter(|(i,_)| i.right>=lo && i.left<=hi) { println!("   {:.17} {:.17} {:?}", i.left,i.right,l); seen+=1; if seen>12 {break;} } println!("--"); };
  for (w,x) in gaps.iter().take(3) { show(x-1e-12,x+w+1e-12); if let SpeedImage::Within(p,q)=im.of_speed(*x) { if let SpeedImage::Within(r,s)=im.of_speed(x+w) { show(p.min(r),q.max(s)); } } }
  // compare with fates
  let fates=Fates::new(passive_hopper::MassRatio::new(m+0.5*dm).unwrap()).unwrap();
  let mut wrong=0; let mut open=0; let count=200000;
  for k in 0..count { let x=b+(t-b)*((k as f64*0.618033988749895).fract()); let f=fates.fate(x).unwrap().label();
    match line.intervals().iter().position(|(i,_)| i.left<=x && x<=i.right) { Some(p)=> if line.intervals()[p].1!=f {wrong+=1}, None=>open+=1 } if k>20000 {break;} }
  println!("wrong {wrong} open {open}");
}
